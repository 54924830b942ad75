#include "pair_lights.h"
#include "pair_choice.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_lights(std::vector<Case>& cases);

/// Lights and choices among them: correct ones, and twins with one edit.
void add_lights(std::vector<Case>& cases) {
  cases.push_back(correct("cone/30 degrees/float", [] {
    return light("cone", Cone<float>({0.6F, 0, 0.8F}, 0.5236F, 0));
  }));
  cases.push_back(twin("cone/30 degrees/float/2π missing", "2π missing: 1/(1 − cosθ_max)",
                       {Kind::constant}, [] {
                         return light("cone", Cone<float>({0.6F, 0, 0.8F}, 0.5236F, 1));
                       }));
  cases.push_back(twin("cone/30 degrees/float/around z",
                       "samples lie around z, not around the axis", {Kind::tangent_frame}, [] {
                         return light("cone", Cone<float>({0.6F, 0, 0.8F}, 0.5236F, 4));
                       }));
  cases.push_back(correct("cone/0.17 degrees/double", [] {
    return light("cone", Cone<double>({0.6, 0, 0.8}, 0.003, 0));
  }));
  cases.push_back(correct("cone/1 degree/float", [] {
    return light("cone", Cone<float>({0.6F, 0, 0.8F}, 0.01745F, 0));
  }));
  cases.push_back(correct("cone/0.023 degrees around z/float", [] {
    return light("cone", Cone<float>({0, 0, 1}, 4e-4F, 0));
  }));
  cases.push_back(correct("sphere light by its cone/double", [] {
    return light("sphere light", sphere_cone<double>({0.3, -0.2, 2}, 0.5, 0));
  }));
  cases.push_back(twin("sphere light by its cone/double/2π missing", "2π missing: 1/(1 − cosθ_max)",
                       {Kind::constant}, [] {
                         return light("sphere light", sphere_cone<double>({0.3, -0.2, 2}, 0.5, 1));
                       }));
  cases.push_back(twin("sphere light by its cone/double/around z",
                       "samples lie around z, not around the centre", {Kind::tangent_frame}, [] {
                         return light("sphere light", sphere_cone<double>({0.3, -0.2, 2}, 0.5, 4));
                       }));
  cases.push_back(correct("sphere light by its area/double", [] {
    return light("sphere light by area", SphereByArea<double>{0, {0.3, -0.2, 2}, 0.7});
  }));
  cases.push_back(
      twin("sphere light by its area/double/cosine missing", "cosθ at the light missing",
           {Kind::distance_or_area, Kind::cosine}, [] {
             return light("sphere light by area", SphereByArea<double>{2, {0.3, -0.2, 2}, 0.7});
           }));
  cases.push_back(
      twin("sphere light by its area/double/r for r²", "distance in place of its square",
           {Kind::distance_or_area}, [] {
             return light("sphere light by area", SphereByArea<double>{3, {0.3, -0.2, 2}, 0.7});
           }));
  cases.push_back(twin(
      "sphere light by its area/double/half the area",
      "pdf for the near half alone: twice, and the far half is rejected", {Kind::constant}, [] {
        return light("sphere light by area", SphereByArea<double>{5, {0.3, -0.2, 2}, 0.7});
      }));
  cases.push_back(correct("sphere light by its area/float", [] {
    return light("sphere light by area", SphereByArea<float>{0, {1, 0.5F, 1.5F}, 0.4F});
  }));
  cases.push_back(correct("rectangle by its area/double", [] {
    return light("rectangle by area",
                 FlatByArea<double>{0, {-0.8, -0.3, 1}, {2, 0, 0.5}, {0, 1, 0.2}});
  }));
  cases.push_back(twin("rectangle by its area/double/cosine missing", "cosθ at the light missing",
                       {Kind::distance_or_area, Kind::cosine}, [] {
                         return light(
                             "rectangle by area",
                             FlatByArea<double>{1, {-0.8, -0.3, 1}, {2, 0, 0.5}, {0, 1, 0.2}});
                       }));
  cases.push_back(twin("rectangle by its area/double/r for r²", "distance in place of its square",
                       {Kind::distance_or_area}, [] {
                         return light(
                             "rectangle by area",
                             FlatByArea<double>{2, {-0.8, -0.3, 1}, {2, 0, 0.5}, {0, 1, 0.2}});
                       }));
  cases.push_back(
      twin("rectangle by its area/double/area for 1/area",
           "times the area in place of over it (L2)", {Kind::constant, Kind::distance_or_area}, [] {
             return light("rectangle by area",
                          FlatByArea<double>{3, {-0.8, -0.3, 1}, {2, 0, 0.5}, {0, 1, 0.2}});
           }));
  cases.push_back(correct("rectangle by its area/float", [] {
    return light("rectangle by area",
                 FlatByArea<float>{0, {-0.8F, -0.3F, 1}, {2, 0, 0.5F}, {0, 1, 0.2F}});
  }));
  cases.push_back(correct("triangle by its area/double", [] {
    return light("triangle by area",
                 FlatByArea<double>{0, {-0.5, -0.5, 1}, {1.5, 0, 0.3}, {0.2, 1.2, 0}, true});
  }));
  cases.push_back(
      twin("triangle by its area/double/root missing", "√u missing", {Kind::radius}, [] {
        return light("triangle by area",
                     FlatByArea<double>{6, {-0.5, -0.5, 1}, {1.5, 0, 0.3}, {0.2, 1.2, 0}, true});
      }));
  cases.push_back(correct("triangle by its area/float", [] {
    return light("triangle by area",
                 FlatByArea<float>{0, {-0.5F, -0.5F, 1}, {1.5F, 0, 0.3F}, {0.2F, 1.2F, 0}, true});
  }));
  cases.push_back(correct("disk light by its area/double", [] {
    return light("disk light",
                 DiskByArea<double>{0, {0.4, 0.2, 1.5}, normalized(Xyz<double>{-0.3, 0, -1}), 0.8});
  }));
  cases.push_back(correct("spherical rectangle/double", [] {
    return light("spherical rectangle", SphericalRectangle<double>(0, -0.7, 1.1, -0.4, 0.9, 1));
  }));
  cases.push_back(correct("spherical rectangle/float", [] {
    return light("spherical rectangle", SphericalRectangle<float>(0, -0.7F, 1.1F, -0.4F, 0.9F, 1));
  }));
  cases.push_back(correct("spherical triangle/double", [] {
    return light("spherical triangle",
                 SphericalTriangle<double>(0, {1, 0.1, 0.2}, {0.1, 1, 0}, {0.2, 0, 1}));
  }));
  cases.push_back(correct("spherical triangle/float", [] {
    return light("spherical triangle",
                 SphericalTriangle<float>(0, {1, 0.1F, 0.2F}, {0.1F, 1, 0}, {0.2F, 0, 1}));
  }));
  cases.push_back(correct("uniform hemisphere/float", [] {
    return pair_of<Xyz<float>>("uniform hemisphere", Domain::hemisphere(),
                               HemisphereWarp<float>{0, Hemisphere::uniform});
  }));
  cases.push_back(twin("uniform hemisphere/float/cosine in the sample",
                       "samples by the cosine, pdf uniform", {Kind::cosine}, [] {
                         return pair_of<Xyz<float>>("uniform hemisphere", Domain::hemisphere(),
                                                    HemisphereWarp<float>{1, Hemisphere::uniform});
                       }));
  cases.push_back(correct("cosine hemisphere/double", [] {
    return pair_of<Xyz<double>>("cosine hemisphere", Domain::hemisphere(),
                                HemisphereWarp<double>{0, Hemisphere::cosine});
  }));
  cases.push_back(
      twin("cosine hemisphere/double/π missing", "cosθ without 1/π", {Kind::constant}, [] {
        return pair_of<Xyz<double>>("cosine hemisphere", Domain::hemisphere(),
                                    HemisphereWarp<double>{2, Hemisphere::cosine});
      }));
  cases.push_back(
      twin("cosine hemisphere/double/cosine missing", "1/π without cosθ", {Kind::cosine}, [] {
        return pair_of<Xyz<double>>("cosine hemisphere", Domain::hemisphere(),
                                    HemisphereWarp<double>{3, Hemisphere::cosine});
      }));
  cases.push_back(correct("cosine-power hemisphere/float", [] {
    return pair_of<Xyz<float>>("power hemisphere", Domain::hemisphere(),
                               HemisphereWarp<float>{0, Hemisphere::power});
  }));
  cases.push_back(correct("sky and ground/double",
                          [] { return light("sky and ground", SkyAndGround<double>{0}); }));
  cases.push_back(twin("sky and ground/double/shares exchanged", "1 − p above and p below",
                       {Kind::constant_per_hemisphere, Kind::lobe_probability},
                       [] { return light("sky and ground", SkyAndGround<double>{2}); }));
  cases.push_back(correct("sky and ground/float",
                          [] { return light("sky and ground", SkyAndGround<float>{0}); }));
  cases.push_back(correct("all lights/double", [] {
    return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(), AllLights<double>(0));
  }));
  cases.push_back(twin(
      "all lights/double/first light only",
      "pdf of the first light hit, with its probability, where another is behind it",
      {Kind::chosen_lobe_only}, [] {
        return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(), AllLights<double>(1));
      }));
  cases.push_back(twin(
      "all lights/double/number not stretched",
      "the number that chose the light is used again as it is (L6)", {Kind::numbers_reused}, [] {
        return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(), AllLights<double>(3));
      }));
  cases.push_back(twin("all lights/double/weight of the chosen light",
                       "weight over the chosen light's own density (B8)",
                       {Kind::weight, Kind::choice_probability, Kind::chosen_lobe_only}, [] {
                         return recorded_pair_of<Xyz<double>>("all lights", Domain::sphere(),
                                                              AllLights<double>(7));
                       }));
  cases.push_back(correct("all lights chosen evenly/float", [] {
    return recorded_pair_of<Xyz<float>>("all lights", Domain::sphere(), AllLights<float>(0, true));
  }));
  cases.push_back(twin("all lights chosen evenly/float/1/n forgotten",
                       "pdf without 1/n for n lights (L17)",
                       {Kind::choice_probability, Kind::constant}, [] {
                         return recorded_pair_of<Xyz<float>>("all lights", Domain::sphere(),
                                                             AllLights<float>(5, true));
                       }));
  cases.push_back(correct("lights by power/10/float", [] {
    return choice<float>("lights by power", 10, LightsByPower<float>(10, 0));
  }));
  cases.push_back(correct("lights by power/1000/double", [] {
    return choice<double>("lights by power", 1000, LightsByPower<double>(1000, 0));
  }));
  cases.push_back(correct("lights by alias table/100/float", [] {
    return choice<float>("lights by alias table", 100, LightsByAlias<float>(100, 0));
  }));
  cases.push_back(twin(
      "lights by alias table/100/float/alias not followed",
      "the table's alias is not followed: lights chosen evenly", {Kind::choice_probability},
      [] { return choice<float>("lights by alias table", 100, LightsByAlias<float>(100, 2)); }));
  cases.push_back(twin(
      "lights by alias table/100/float/keep and alias exchanged",
      "the alias is taken where the light should be kept", {Kind::choice_probability},
      [] { return choice<float>("lights by alias table", 100, LightsByAlias<float>(100, 3)); }));
  cases.push_back(correct("light tree/16/float",
                          [] { return choice<float>("light tree", 16, LightTree<float>(4, 0)); }));
  cases.push_back(twin("light tree/16/float/left share always",
                       "the left child's share for right children too (B31)",
                       {Kind::choice_probability},
                       [] { return choice<float>("light tree", 16, LightTree<float>(4, 2)); }));
  cases.push_back(correct("light tree/256/double", [] {
    return choice<double>("light tree", 256, LightTree<double>(8, 0));
  }));
  cases.push_back(correct("reservoir/12/double", [] {
    return choice<double>("reservoir", 12, Reservoir<double>{0, lamp_powers<double>(12)});
  }));
}

}  // namespace plumbline::tests::corpus
