#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// CPU time from the start of a battery to its verdict, with the users' options, beside what the
/// code under test takes of it: of a small and of a production BSDF, of a light, a warp and a gross
/// fault, and per million samples of chi-square. Three rounds in turns, or nine where all is asked
/// for.
void measure_verdict_time(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
