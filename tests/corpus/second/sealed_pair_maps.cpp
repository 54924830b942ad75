// The second set of faulty twins: kept apart until it had been scored once.
#include "pair_maps.h"
#include "pair_support.h"
#include "pair_tables.h"

namespace plumbline::tests::corpus {

void add_sealed_maps(std::vector<Case>& cases);

/// Environment maps and tables: twins.
void add_sealed_maps(std::vector<Case>& cases) {
  cases.push_back(twin("environment map by rows/8x4/double/sine at the row",
                       "pdf takes sinθ at the row's middle, samples are uniform in θ (L12)",
                       {Kind::sine}, [] { return map_by_rows<double>(8, 4, 0, false, 2); }));
  cases.push_back(twin("environment map by rows/32x16/double/row below", "pdf reads the row below",
                       {Kind::shifted}, [] { return map_by_rows<double>(32, 16, 0, false, 3); }));
  cases.push_back(twin("environment map by rows/32x16/double/row without its probability",
                       "pdf is the conditional density only: the probability of the row is missing",
                       {Kind::choice_probability},
                       [] { return map_by_rows<double>(32, 16, 0, false, 8); }));
  cases.push_back(twin("environment map by rows/32x16 black rows/double/π² for 2π²",
                       "pdf divides by π² in place of 2π²", {Kind::constant},
                       [] { return map_by_rows<double>(32, 16, 100, true, 7); }));
  cases.push_back(twin("compensated environment map/32x16/float/row below",
                       "pdf reads the row below", {Kind::shifted},
                       [] { return map_compensated<float>(32, 16, 40, 3); }));
  cases.push_back(twin("compensated environment map/32x16/float/π² for 2π²",
                       "pdf divides by π² in place of 2π²", {Kind::constant},
                       [] { return map_compensated<float>(32, 16, 40, 7); }));
  cases.push_back(twin("environment map by alias table/16x8/double/keep and alias exchanged",
                       "the alias is taken where the texel should be kept",
                       {Kind::choice_probability},
                       [] { return map_by_alias<double>(16, 8, 20, 3); }));
  cases.push_back(twin("environment map by alias table/16x8/double/weight over probability",
                       "weight is radiance over the texel's probability", {Kind::weight},
                       [] { return map_by_alias<double>(16, 8, 20, 6); }));
  cases.push_back(twin("environment map by alias table/16x8/double/record without sinθ",
                       "the record's pdf lacks 1/sinθ, pdf() is right",
                       {Kind::record_pdf, Kind::sine},
                       [] { return map_by_alias<double>(16, 8, 20, 7); }));
  cases.push_back(twin(
      "environment map by alias table/32x16 with a sun/float/texels without their sine",
      "table built from radiance alone, pdf from radiance times sine",
      {Kind::sine, Kind::choice_probability}, [] { return map_by_alias<float>(32, 16, 5000, 4); }));
  cases.push_back(
      twin("environment map by alias table/32x16 with a sun/float/row and column exchanged",
           "pdf looks up (v, u)", {Kind::mirrored},
           [] { return map_by_alias<float>(32, 16, 5000, 5); }));
  cases.push_back(twin("octahedral environment map/16/double/transposed", "pdf looks up (y, x)",
                       {Kind::mirrored}, [] { return map_octahedral<double>(16, 0, 2); }));
  cases.push_back(twin("interpolated environment map/32x16/double/pdf without sinθ",
                       "1/sinθ missing from the pdf (L12)", {Kind::sine}, [] {
                         return pair_of<Xyz<double>>("interpolated environment map",
                                                     Domain::sphere(),
                                                     SmoothMap<double>(1, 32, 16));
                       }));
  cases.push_back(twin("interpolated environment map/32x16/double/times sinθ",
                       "pdf times sinθ in place of over it", {Kind::sine}, [] {
                         return pair_of<Xyz<double>>("interpolated environment map",
                                                     Domain::sphere(),
                                                     SmoothMap<double>(2, 32, 16));
                       }));
  cases.push_back(twin("interpolated environment map/32x16/double/half a texel",
                       "nodes taken for centres: half a texel to the side", {Kind::shifted}, [] {
                         return pair_of<Xyz<double>>("interpolated environment map",
                                                     Domain::sphere(),
                                                     SmoothMap<double>(3, 32, 16));
                       }));
  cases.push_back(twin("interpolated environment map/32x16/double/mirrored in φ",
                       "pdf reads the map mirrored in φ", {Kind::mirrored}, [] {
                         return pair_of<Xyz<double>>("interpolated environment map",
                                                     Domain::sphere(),
                                                     SmoothMap<double>(4, 32, 16));
                       }));
  cases.push_back(twin("measured lobe/24x17/double/x missing",
                       "dθ/dx = πx taken as π: a factor x missing", {Kind::radius, Kind::sine},
                       [] { return measured_lobe<double>(1); }));
  cases.push_back(
      twin("bilinear table/24x17/double/mirrored", "pdf at 1 − x", {Kind::mirrored}, [] {
        return pair_of<Xy<double>>(
            "bilinear table", Domain::unit_square(),
            BilinearTable<double>(2, 24, 17, measured_values<double>(24, 17, false)));
      }));
  cases.push_back(
      twin("bilinear table/24x17/double/cells not counted", "number of cells missing from the pdf",
           {Kind::constant}, [] {
             return pair_of<Xy<double>>(
                 "bilinear table", Domain::unit_square(),
                 BilinearTable<double>(3, 24, 17, measured_values<double>(24, 17, false)));
           }));
}

}  // namespace plumbline::tests::corpus
