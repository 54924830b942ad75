#include "pair_maps.h"
#include "pair_support.h"
#include "pair_tables.h"

namespace plumbline::tests::corpus {

void add_maps(std::vector<Case>& cases);

/// Environment maps and tables: correct ones, and twins with one edit.
void add_maps(std::vector<Case>& cases) {
  cases.push_back(correct("environment map by rows/8x4/double",
                          [] { return map_by_rows<double>(8, 4, 0, false); }));
  cases.push_back(twin("environment map by rows/8x4/double/column of another row",
                       "the column is drawn from the row below", {Kind::shifted},
                       [] { return map_by_rows<double>(8, 4, 0, false, 10); }));
  cases.push_back(correct("environment map by rows/32x16/double",
                          [] { return map_by_rows<double>(32, 16, 0, false); }));
  cases.push_back(twin("environment map by rows/32x16/double/pdf without sinθ",
                       "1/sinθ missing from the pdf (L12)", {Kind::sine},
                       [] { return map_by_rows<double>(32, 16, 0, false, 1); }));
  cases.push_back(twin("environment map by rows/32x16/double/mirrored in φ",
                       "pdf reads the map mirrored in φ", {Kind::mirrored},
                       [] { return map_by_rows<double>(32, 16, 0, false, 5); }));
  cases.push_back(twin("environment map by rows/32x16/double/row remembered",
                       "pdf uses the row of the last sample", {Kind::stale_state},
                       [] { return map_by_rows<double>(32, 16, 0, false, 11); }));
  cases.push_back(correct("environment map by rows/32x16 with a sun/float",
                          [] { return map_by_rows<float>(32, 16, 500, false); }));
  cases.push_back(twin("environment map by rows/32x16 with a sun/float/half a texel",
                       "pdf looks half a texel to the side", {Kind::shifted},
                       [] { return map_by_rows<float>(32, 16, 500, false, 4); }));
  cases.push_back(twin("environment map by rows/32x16 with a sun/float/upside down",
                       "pdf reads the map upside down", {Kind::mirrored},
                       [] { return map_by_rows<float>(32, 16, 500, false, 6); }));
  cases.push_back(correct("environment map by rows/32x16 black rows/double",
                          [] { return map_by_rows<double>(32, 16, 100, true); }));
  cases.push_back(twin("environment map by rows/32x16 black rows/double/rows without their sine",
                       "pdf from texels that are not weighted by the row's sine", {Kind::sine},
                       [] { return map_by_rows<double>(32, 16, 100, true, 12); }));
  cases.push_back(twin("environment map by rows/32x16 black rows/double/texel centres",
                       "samples are the centres of texels", {Kind::on_a_line},
                       [] { return map_by_rows<double>(32, 16, 100, true, 9); }));
  cases.push_back(correct("environment map by rows/64x32 with a sun/float", [] {
    return on_map_domain(map_by_rows<float>(64, 32, 50000, true), 64, 32);
  }));
  cases.push_back(correct("environment map by rows/128x64 with a sun/double", [] {
    return on_map_domain(map_by_rows<double>(128, 64, 50000, false), 128, 64);
  }));
  cases.push_back(
      twin("environment map by rows/128x64 with a sun/double/pdf without sinθ",
           "1/sinθ missing from the pdf (L12)", {Kind::sine},
           [] { return on_map_domain(map_by_rows<double>(128, 64, 50000, false, 1), 128, 64); }));
  cases.push_back(
      twin("environment map by rows/128x64 with a sun/double/half a texel",
           "pdf looks half a texel to the side", {Kind::shifted},
           [] { return on_map_domain(map_by_rows<double>(128, 64, 50000, false, 4), 128, 64); }));
  cases.push_back(correct("compensated environment map/32x16/float",
                          [] { return map_compensated<float>(32, 16, 40); }));
  cases.push_back(correct("compensated environment map/64x32/double", [] {
    return on_map_domain(map_compensated<double>(64, 32, 1000), 64, 32);
  }));
  cases.push_back(correct("environment map by alias table/16x8/double",
                          [] { return map_by_alias<double>(16, 8, 20); }));
  cases.push_back(twin("environment map by alias table/16x8/double/number not stretched",
                       "the number that chose the texel is used again as it is left (L6)",
                       {Kind::numbers_reused}, [] { return map_by_alias<double>(16, 8, 20, 1); }));
  cases.push_back(twin("environment map by alias table/16x8/double/probability for density",
                       "pdf is the texel's probability, not times the number of texels",
                       {Kind::constant}, [] { return map_by_alias<double>(16, 8, 20, 2); }));
  cases.push_back(correct("environment map by alias table/32x16 with a sun/float",
                          [] { return map_by_alias<float>(32, 16, 5000); }));
  cases.push_back(correct("octahedral environment map/16/double",
                          [] { return map_octahedral<double>(16, 0); }));
  cases.push_back(twin("octahedral environment map/16/double/pdf per square", "1/(4π) missing",
                       {Kind::constant}, [] { return map_octahedral<double>(16, 0, 1); }));
  cases.push_back(twin("octahedral environment map/16/double/half a cell",
                       "pdf looks half a cell to the side", {Kind::shifted},
                       [] { return map_octahedral<double>(16, 0, 4); }));
  cases.push_back(correct("octahedral environment map/32 with a sun/float",
                          [] { return map_octahedral<float>(32, 2000); }));
  cases.push_back(twin("octahedral environment map/32 with a sun/float/lower half as upper",
                       "pdf folds the lower hemisphere onto the upper", {Kind::mirrored},
                       [] { return map_octahedral<float>(32, 2000, 3); }));
  cases.push_back(correct("interpolated environment map/32x16/double", [] {
    return pair_of<Xyz<double>>("interpolated environment map", Domain::sphere(),
                                SmoothMap<double>(0, 32, 16));
  }));
  cases.push_back(correct("interpolated environment map/16x8/float", [] {
    return pair_of<Xyz<float>>("interpolated environment map", Domain::sphere(),
                               SmoothMap<float>(0, 16, 8));
  }));
  cases.push_back(twin("interpolated environment map/16x8/float/row below",
                       "pdf reads the row below", {Kind::shifted}, [] {
                         return pair_of<Xyz<float>>("interpolated environment map",
                                                    Domain::sphere(), SmoothMap<float>(6, 16, 8));
                       }));
  cases.push_back(correct("measured lobe/24x17/double", [] { return measured_lobe<double>(0); }));
  cases.push_back(twin("measured lobe/24x17/double/sine missing", "1/sinθ missing", {Kind::sine},
                       [] { return measured_lobe<double>(2); }));
  cases.push_back(
      twin("measured lobe/24x17/double/row above",
           "the conditional is the row's, not interpolated, and the pdf reads the row below",
           {Kind::shifted}, [] { return measured_lobe<double>(0, 4); }));
  cases.push_back(correct("measured lobe/24x17/float", [] { return measured_lobe<float>(0); }));
  cases.push_back(twin("measured lobe/24x17/float/half a cell",
                       "nodes taken for centres: half a cell to the side in θ", {Kind::shifted},
                       [] { return measured_lobe<float>(0, 1); }));
  cases.push_back(correct("bilinear table/24x17/double", [] {
    return pair_of<Xy<double>>(
        "bilinear table", Domain::unit_square(),
        BilinearTable<double>(0, 24, 17, measured_values<double>(24, 17, false)));
  }));
}

}  // namespace plumbline::tests::corpus
