#include "pair_shapes.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_shapes(std::vector<Case>& cases);

/// Areas: correct ones, and twins with one edit.
void add_shapes(std::vector<Case>& cases) {
  cases.push_back(correct("disk, polar/radius 2/double", [] {
    return pair_of<Xy<double>>("disk, polar", Domain::disk(2), DiskPolar<double>{0, 2});
  }));
  cases.push_back(
      twin("disk, polar/radius 2/double/root missing", "√u missing: r uniform", {Kind::radius}, [] {
        return pair_of<Xy<double>>("disk, polar", Domain::disk(2), DiskPolar<double>{1, 2});
      }));
  cases.push_back(
      twin("disk, polar/radius 2/double/radius not squared", "1/π for a disk of radius 2",
           {Kind::constant, Kind::distance_or_area}, [] {
             return pair_of<Xy<double>>("disk, polar", Domain::disk(2), DiskPolar<double>{2, 2});
           }));
  cases.push_back(correct("disk, polar/float", [] {
    return pair_of<Xy<float>>("disk, polar", Domain::disk(1), DiskPolar<float>{0, 1});
  }));
  cases.push_back(
      twin("disk, polar/float/root missing", "√u missing: r uniform", {Kind::radius}, [] {
        return pair_of<Xy<float>>("disk, polar", Domain::disk(1), DiskPolar<float>{1, 1});
      }));
  cases.push_back(correct("disk, concentric/double", [] {
    return pair_of<Xy<double>>("disk, concentric", Domain::disk(1), DiskConcentric<double>{0, 1});
  }));
  cases.push_back(correct("disk, concentric/float", [] {
    return pair_of<Xy<float>>("disk, concentric", Domain::disk(1), DiskConcentric<float>{0, 1});
  }));
  cases.push_back(correct("triangle by root/double", [] {
    return pair_of<Xy<double>>("triangle", Domain::triangle(),
                               Triangle<double>{0, TriangleMap::root});
  }));
  cases.push_back(correct("triangle by fold/float", [] {
    return pair_of<Xy<float>>("triangle", Domain::triangle(),
                              Triangle<float>{0, TriangleMap::fold});
  }));
  cases.push_back(twin("triangle by fold/float/not folded", "points beyond the diagonal kept",
                       {Kind::not_rejected, Kind::support}, [] {
                         return pair_of<Xy<float>>("triangle", Domain::triangle(),
                                                   Triangle<float>{3, TriangleMap::fold});
                       }));
  cases.push_back(correct("triangle by halves/double", [] {
    return pair_of<Xy<double>>("triangle", Domain::triangle(),
                               Triangle<double>{0, TriangleMap::half});
  }));
  cases.push_back(twin("triangle by halves/double/half not taken off",
                       "the second coordinate keeps the half that the first got", {Kind::support},
                       [] {
                         return pair_of<Xy<double>>("triangle", Domain::triangle(),
                                                    Triangle<double>{4, TriangleMap::half});
                       }));
  cases.push_back(correct("ellipse/double", [] {
    return pair_of<Xyz<double>>("ellipse", ellipse_domain(2, 0.5), Ellipse<double>{0, 2, 0.5});
  }));
  cases.push_back(correct("cylinder/float", [] {
    return pair_of<Xyz<float>>("cylinder", cylinder_domain(0.5, 2), Cylinder<float>{0, 0.5F, 2});
  }));
  cases.push_back(
      twin("cylinder/float/root of the height", "√v along the axis", {Kind::radius}, [] {
        return pair_of<Xyz<float>>("cylinder", cylinder_domain(0.5, 2),
                                   Cylinder<float>{2, 0.5F, 2});
      }));
  cases.push_back(correct("aperture/6/float", [] {
    return pair_of<Xy<float>>("aperture", Domain::disk(), Aperture<float>{0, 6});
  }));
  cases.push_back(twin(
      "aperture/6/float/number not stretched",
      "the number that chose the blade is used again as it is (L6)", {Kind::numbers_reused}, [] {
        return pair_of<Xy<float>>("aperture", Domain::disk(), Aperture<float>{1, 6});
      }));
  cases.push_back(correct("aperture/5/double", [] {
    return pair_of<Xy<double>>("aperture", Domain::disk(), Aperture<double>{0, 5});
  }));
  cases.push_back(twin("aperture/5/double/root missing", "√u missing", {Kind::radius}, [] {
    return pair_of<Xy<double>>("aperture", Domain::disk(), Aperture<double>{2, 5});
  }));
  cases.push_back(correct("pixel filter/Gaussian/float", [] {
    return pair_of<Xy<float>>("pixel filter", Domain::unit_square(),
                              PixelFilter<float>(Filter::gaussian, 0));
  }));
  cases.push_back(correct("pixel filter/Mitchell/double", [] {
    return pair_of<Xy<double>>("pixel filter", Domain::unit_square(),
                               PixelFilter<double>(Filter::mitchell, 0));
  }));
  cases.push_back(correct("pixel filter/tent/double", [] {
    return pair_of<Xy<double>>("pixel filter", Domain::unit_square(),
                               PixelFilter<double>(Filter::tent, 0));
  }));
  cases.push_back(correct("bilinear patch/float", [] {
    return pair_of<Xy<float>>("bilinear patch", Domain::unit_square(),
                              BilinearPatch<float>{0, {1, 3, 0.2F, 0}});
  }));
  cases.push_back(
      twin("bilinear patch/float/x and y exchanged", "pdf at (y, x)", {Kind::mirrored}, [] {
        return pair_of<Xy<float>>("bilinear patch", Domain::unit_square(),
                                  BilinearPatch<float>{2, {1, 3, 0.2F, 0}});
      }));
  cases.push_back(correct("Gaussian in a pixel/double", [] {
    return pair_of<Xy<double>>("Gaussian in a pixel", Domain::unit_square(),
                               GaussianRetried<double>{0});
  }));
  cases.push_back(twin("Gaussian in a pixel/double/retries not in the pdf",
                       "pdf of the Gaussian over the whole plane",
                       {Kind::not_rejected, Kind::constant}, [] {
                         return pair_of<Xy<double>>("Gaussian in a pixel", Domain::unit_square(),
                                                    GaussianRetried<double>{1});
                       }));
}

}  // namespace plumbline::tests::corpus
