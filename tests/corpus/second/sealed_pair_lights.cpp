// The second set of faulty twins: kept apart until it had been scored once.
#include "pair_choice.h"
#include "pair_lights.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_sealed_lights(std::vector<Case>& cases);

/// Lights and choices among them: twins.
void add_sealed_lights(std::vector<Case>& cases) {
  cases.push_back(twin("cone/30 degrees/float/number squared", "cosθ taken uniform in u²",
                       {Kind::radius, Kind::sine}, [] {
                         return light("cone", Cone<float>({0.6F, 0, 0.8F}, 0.5236F, 3));
                       }));
  cases.push_back(twin("cone/0.023 degrees around z/float/1 − cosθ in float",
                       "solid angle of the pdf from 1 − cosθ in float (L4)",
                       {Kind::precision, Kind::constant}, [] {
                         return light("cone", Cone<float>({0, 0, 1}, 4e-4F, 2));
                       }));
  cases.push_back(
      twin("sphere light by its area/double/far side kept",
           "points that face away are not rejected", {Kind::not_rejected}, [] {
             return light("sphere light by area", SphereByArea<double>{1, {0.3, -0.2, 2}, 0.7});
           }));
  cases.push_back(
      twin("sphere light by its area/double/density per area",
           "pdf per area in place of solid angle (T4)", {Kind::distance_or_area}, [] {
             return light("sphere light by area", SphereByArea<double>{4, {0.3, -0.2, 2}, 0.7});
           }));
  cases.push_back(twin("rectangle by its area/double/density per area",
                       "pdf per area in place of solid angle (T4)", {Kind::distance_or_area}, [] {
                         return light(
                             "rectangle by area",
                             FlatByArea<double>{4, {-0.8, -0.3, 1}, {2, 0, 0.5}, {0, 1, 0.2}});
                       }));
  cases.push_back(twin(
      "rectangle by its area/float/distance missing", "r² missing", {Kind::distance_or_area}, [] {
        return light("rectangle by area",
                     FlatByArea<float>{5, {-0.8F, -0.3F, 1}, {2, 0, 0.5F}, {0, 1, 0.2F}});
      }));
  cases.push_back(twin("triangle by its area/double/cosine missing", "cosθ at the light missing",
                       {Kind::distance_or_area, Kind::cosine}, [] {
                         return light("triangle by area",
                                      FlatByArea<double>{
                                          1, {-0.5, -0.5, 1}, {1.5, 0, 0.3}, {0.2, 1.2, 0}, true});
                       }));
  cases.push_back(
      twin("disk light by its area/double/density per area",
           "pdf per area in place of solid angle (T4)", {Kind::distance_or_area}, [] {
             return light(
                 "disk light",
                 DiskByArea<double>{1, {0.4, 0.2, 1.5}, normalized(Xyz<double>{-0.3, 0, -1}), 0.8});
           }));
  cases.push_back(
      twin("disk light by its area/double/diameter for radius",
           "area from the diameter: a quarter of the pdf", {Kind::constant}, [] {
             return light(
                 "disk light",
                 DiskByArea<double>{2, {0.4, 0.2, 1.5}, normalized(Xyz<double>{-0.3, 0, -1}), 0.8});
           }));
  cases.push_back(
      twin("disk light by its area/double/root missing", "√u missing", {Kind::radius}, [] {
        return light(
            "disk light",
            DiskByArea<double>{3, {0.4, 0.2, 1.5}, normalized(Xyz<double>{-0.3, 0, -1}), 0.8});
      }));
  cases.push_back(twin(
      "spherical rectangle/double/1/area", "pdf is 1/area in place of 1/solid angle",
      {Kind::distance_or_area, Kind::constant}, [] {
        return light("spherical rectangle", SphericalRectangle<double>(1, -0.7, 1.1, -0.4, 0.9, 1));
      }));
  cases.push_back(twin(
      "spherical rectangle/double/y uniform in area",
      "y uniform along the edge, pdf uniform in solid angle", {Kind::distance_or_area}, [] {
        return light("spherical rectangle", SphericalRectangle<double>(2, -0.7, 1.1, -0.4, 0.9, 1));
      }));
  cases.push_back(twin("spherical triangle/double/excess without π", "solid angle without − π",
                       {Kind::constant}, [] {
                         return light(
                             "spherical triangle",
                             SphericalTriangle<double>(1, {1, 0.1, 0.2}, {0.1, 1, 0}, {0.2, 0, 1}));
                       }));
  cases.push_back(twin(
      "spherical triangle/double/number squared", "the second number squared", {Kind::radius}, [] {
        return light("spherical triangle",
                     SphericalTriangle<double>(2, {1, 0.1, 0.2}, {0.1, 1, 0}, {0.2, 0, 1}));
      }));
  cases.push_back(
      twin("uniform hemisphere/float/1/(4π)", "1/(4π) of the whole sphere", {Kind::constant}, [] {
        return pair_of<Xyz<float>>("uniform hemisphere", Domain::hemisphere(),
                                   HemisphereWarp<float>{2, Hemisphere::uniform});
      }));
  cases.push_back(twin("cosine-power hemisphere/float/exponent without + 1",
                       "cosθ = u^(1/n), pdf for n", {Kind::cosine}, [] {
                         return pair_of<Xyz<float>>("power hemisphere", Domain::hemisphere(),
                                                    HemisphereWarp<float>{4, Hemisphere::power});
                       }));
  cases.push_back(twin("sky and ground/double/share of the ground missing",
                       "probability of the lower half missing from the pdf",
                       {Kind::constant_per_hemisphere, Kind::lobe_probability},
                       [] { return light("sky and ground", SkyAndGround<double>{1}); }));
  cases.push_back(twin("sky and ground/double/number not stretched",
                       "the number that chose the half is used again as it is (L6)",
                       {Kind::numbers_reused},
                       [] { return light("sky and ground", SkyAndGround<double>{3}); }));
  cases.push_back(twin("sky and ground/float/as if even",
                       "pdf of equal shares, samples in proportion to power",
                       {Kind::constant_per_hemisphere, Kind::lobe_probability},
                       [] { return light("sky and ground", SkyAndGround<float>{4}); }));
  cases.push_back(twin("all lights/double/record without the choice",
                       "the record lacks the probability of the light (M7)",
                       {Kind::record_pdf, Kind::choice_probability}, [] {
                         return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(),
                                                              AllLights<double>(2));
                       }));
  cases.push_back(twin("all lights/double/chosen evenly", "lights chosen evenly, pdf by power",
                       {Kind::choice_probability}, [] {
                         return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(),
                                                              AllLights<double>(4));
                       }));
  cases.push_back(twin("all lights/double/record of the chosen light",
                       "record holds the chosen light's pdf where two overlap (B7)",
                       {Kind::chosen_lobe_only, Kind::record_pdf}, [] {
                         return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(),
                                                              AllLights<double>(6));
                       }));
  cases.push_back(twin("all lights/double/one probability missing",
                       "the probability of one of the lights is missing",
                       {Kind::choice_probability, Kind::lobe_probability}, [] {
                         return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(),
                                                              AllLights<double>(8));
                       }));
  cases.push_back(
      twin("lights by power/10/float/next light", "pmf of the next light", {Kind::shifted},
           [] { return choice<float>("lights by power", 10, LightsByPower<float>(10, 2)); }));
  cases.push_back(twin(
      "lights by power/10/float/even pmf", "pmf 1/n, chosen by power", {Kind::choice_probability},
      [] { return choice<float>("lights by power", 10, LightsByPower<float>(10, 1)); }));
  cases.push_back(
      twin("lights by power/1000/double/density for probability",
           "pmf times n: density of the table", {Kind::constant},
           [] { return choice<double>("lights by power", 1000, LightsByPower<double>(1000, 3)); }));
  cases.push_back(twin("light tree/16/float/root forgotten",
                       "probability of the first level missing", {Kind::choice_probability},
                       [] { return choice<float>("light tree", 16, LightTree<float>(4, 1)); }));
  cases.push_back(twin("light tree/16/float/number not stretched",
                       "the same number at each level (L6)", {Kind::numbers_reused},
                       [] { return choice<float>("light tree", 16, LightTree<float>(4, 3)); }));
  cases.push_back(
      twin("reservoir/12/double/weight counted twice", "the candidate's weight is in the sum twice",
           {Kind::choice_probability}, [] {
             return choice<double>("reservoir", 12, Reservoir<double>{1, lamp_powers<double>(12)});
           }));
  cases.push_back(
      twin("reservoir/12/double/weight missing", "pmf 1/Σw without the light's weight",
           {Kind::choice_probability}, [] {
             return choice<double>("reservoir", 12, Reservoir<double>{2, lamp_powers<double>(12)});
           }));
}

}  // namespace plumbline::tests::corpus
