#pragma once

#include <cmath>
#include <functional>
#include <string>

#include <plumbline/verify/history/regressions.h>

#include "history_noise.h"

namespace plumbline::verify::history {

/// How a simulated machine scatters; standard deviations are relative to the level.
struct NightNoise {
  double spread = 0.01;      ///< from night to night, and of the values of a night
  double correlation = 0.3;  ///< of neighbouring nights; that of neighbouring values is 0.5
  double odd = 0;            ///< share of the nights that take up to ten spreads longer
};

/// Fifteen values of one more night around a level.
inline Night simulated_night(Random& random, const NightNoise& noise, CorrelatedNoise& nights,
                             double level) {
  Night night;
  double exponent = noise.spread * nights.next();
  if (random.uniform() < noise.odd) exponent += 10 * noise.spread * random.uniform();
  CorrelatedNoise within(random, 0.5);
  for (int k = 0; k < 15; ++k) {
    night.values.push_back(level * std::exp(exponent + noise.spread * within.next()));
  }
  return night;
}

/// @param true_level  of each night, positive
inline Series simulated_history(Random& random, int nights, const NightNoise& noise,
                                const std::function<double(int)>& true_level) {
  CorrelatedNoise night_noise(random, noise.correlation);
  Series series;
  for (int i = 0; i < nights; ++i) {
    series.nights.push_back(simulated_night(random, noise, night_noise, true_level(i)));
    series.nights.back().commit = "c" + std::to_string(i);
  }
  return series;
}

}  // namespace plumbline::verify::history
