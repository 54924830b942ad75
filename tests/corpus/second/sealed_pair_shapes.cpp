// The second set of faulty twins: kept apart until it had been scored once.
#include "pair_shapes.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_sealed_shapes(std::vector<Case>& cases);

/// Areas: twins.
void add_sealed_shapes(std::vector<Case>& cases) {
  cases.push_back(
      twin("disk, polar/radius 2/double/area for 1/area", "the area in place of 1/area (L2)",
           {Kind::constant, Kind::distance_or_area}, [] {
             return pair_of<Xy<double>>("disk, polar", Domain::disk(2), DiskPolar<double>{3, 2});
           }));
  cases.push_back(twin("disk, concentric/double/root twice",
                       "a root taken of a radius that is uniform in area already", {Kind::radius},
                       [] {
                         return pair_of<Xy<double>>("disk, concentric", Domain::disk(1),
                                                    DiskConcentric<double>{1, 1});
                       }));
  cases.push_back(
      twin("disk, concentric/double/1/(2πr)", "pdf as if r were uniform", {Kind::radius}, [] {
        return pair_of<Xy<double>>("disk, concentric", Domain::disk(1),
                                   DiskConcentric<double>{2, 1});
      }));
  cases.push_back(twin("triangle by root/double/root missing", "√u missing", {Kind::radius}, [] {
    return pair_of<Xy<double>>("triangle", Domain::triangle(),
                               Triangle<double>{1, TriangleMap::root});
  }));
  cases.push_back(twin("triangle by root/double/1 for 2", "half the density", {Kind::constant}, [] {
    return pair_of<Xy<double>>("triangle", Domain::triangle(),
                               Triangle<double>{2, TriangleMap::root});
  }));
  cases.push_back(twin(
      "ellipse/double/a² for ab", "area of a circle", {Kind::constant, Kind::distance_or_area}, [] {
        return pair_of<Xyz<double>>("ellipse", ellipse_domain(2, 0.5), Ellipse<double>{1, 2, 0.5});
      }));
  cases.push_back(twin(
      "ellipse/double/area for 1/area", "the area in place of 1/area (L2)",
      {Kind::constant, Kind::distance_or_area}, [] {
        return pair_of<Xyz<double>>("ellipse", ellipse_domain(2, 0.5), Ellipse<double>{2, 2, 0.5});
      }));
  cases.push_back(twin("cylinder/float/volume for area", "1/volume in place of 1/area",
                       {Kind::constant, Kind::distance_or_area}, [] {
                         return pair_of<Xyz<float>>("cylinder", cylinder_domain(0.5, 2),
                                                    Cylinder<float>{1, 0.5F, 2});
                       }));
  cases.push_back(
      twin("aperture/6/float/area of the circle", "1/π in place of 1/area of the polygon",
           {Kind::constant, Kind::distance_or_area}, [] {
             return pair_of<Xy<float>>("aperture", Domain::disk(), Aperture<float>{3, 6});
           }));
  cases.push_back(twin("pixel filter/Gaussian/float/half a cell", "pdf half a cell to the side",
                       {Kind::shifted}, [] {
                         return pair_of<Xy<float>>("pixel filter", Domain::unit_square(),
                                                   PixelFilter<float>(Filter::gaussian, 1));
                       }));
  cases.push_back(twin("pixel filter/Gaussian/float/cells not counted", "number of cells missing",
                       {Kind::constant}, [] {
                         return pair_of<Xy<float>>("pixel filter", Domain::unit_square(),
                                                   PixelFilter<float>(Filter::gaussian, 3));
                       }));
  cases.push_back(twin("pixel filter/Mitchell/double/negative lobes",
                       "the filter's own value in the pdf, negative at the sides",
                       {Kind::not_finite}, [] {
                         return pair_of<Xy<double>>("pixel filter", Domain::unit_square(),
                                                    PixelFilter<double>(Filter::mitchell, 2));
                       }));
  cases.push_back(twin("pixel filter/Mitchell/double/cell centres",
                       "samples are the centres of cells", {Kind::on_a_line}, [] {
                         return pair_of<Xy<double>>("pixel filter", Domain::unit_square(),
                                                    PixelFilter<double>(Filter::mitchell, 4));
                       }));
  cases.push_back(
      twin("bilinear patch/float/4 missing", "corners' sum not divided by 4", {Kind::constant}, [] {
        return pair_of<Xy<float>>("bilinear patch", Domain::unit_square(),
                                  BilinearPatch<float>{1, {1, 3, 0.2F, 0}});
      }));
  cases.push_back(twin("bilinear patch/float/mirrored", "pdf at 1 − x", {Kind::mirrored}, [] {
    return pair_of<Xy<float>>("bilinear patch", Domain::unit_square(),
                              BilinearPatch<float>{3, {1, 3, 0.2F, 0}});
  }));
  cases.push_back(twin("Gaussian in a pixel/double/clamped", "clamped to the pixel, not retried",
                       {Kind::on_a_line}, [] {
                         return pair_of<Xy<double>>("Gaussian in a pixel", Domain::unit_square(),
                                                    GaussianRetried<double>{2});
                       }));
}

}  // namespace plumbline::tests::corpus
