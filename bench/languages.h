#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Seconds of one battery, from one direction, on the same Lambertian BSDF in every language that
/// this build has: in C++, in Python, and in programs that answer `plumbline verify`. One round, or
/// five where all is asked for, in turns.
void measure_languages(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
