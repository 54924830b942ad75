#pragma once

namespace plumbline::verify {

/// Sums that moments of samples are kept as; n is a count.
struct CentralMoments {
  double n = 0, mean = 0;
  double m2 = 0, m3 = 0;  ///< sums of squared and of cubed deviations from the mean
};

/// Those of both sets together.
///
/// @param a, b  not both empty
/// @source Chan, Golub, LeVeque 1979, Eq. 2.1 · Pébay 2008 (SAND2008-6212), Eq. 2.1
inline CentralMoments merged(const CentralMoments& a, const CentralMoments& b) {
  const double n = a.n + b.n, delta = b.mean - a.mean;
  CentralMoments result;
  result.n = n;
  result.mean = a.mean + delta * b.n / n;
  result.m2 = a.m2 + (b.m2 + delta * delta * a.n * b.n / n);
  result.m3 = a.m3 + (b.m3 + delta * delta * delta * a.n * b.n * (a.n - b.n) / (n * n) +
                      3 * delta * (a.n * b.m2 - b.n * a.m2) / n);
  return result;
}

/// Share of m2 that the single most deviating sample carries, in [0, 1]; 0 where m2 is 0.
inline double largest_share(const CentralMoments& all, double smallest, double largest) {
  if (!(all.m2 > 0)) return 0;
  const double high = largest - all.mean, low = all.mean - smallest;
  const double deviation = high > low ? high : low;
  const double share = deviation * deviation / all.m2;
  return share < 1 ? share : 1;
}

}  // namespace plumbline::verify
