#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumbline::reports {

struct FigureAxis {
  std::string label;  ///< quantity and unit: "time [s]"
  bool log = false;   ///< points that are not > 0 are left out

  bool operator==(const FigureAxis&) const = default;
};

enum class SeriesStyle {
  points,  ///< measured: markers joined by a thin line
  line,    ///< a curve, no markers
  dashed   ///< a prediction to compare with
};

/// Series of one name (measured points and the prediction for them) share a colour and an entry of
/// the legend, that of the first.
struct FigureSeries {
  std::string name;
  SeriesStyle style = SeriesStyle::points;
  std::vector<double> x, y;       ///< same length; a NaN in y is a gap
  std::vector<double> low, high;  ///< of y, drawn as bars; both empty or both as long as y

  bool operator==(const FigureSeries&) const = default;
};

/// A plot on the page. JSON format "plumbline.figure/1".
struct Figure {
  std::string group;  ///< heading it stands under: "Integrals with known answers"
  std::string title;
  std::string caption;  ///< what to look for
  FigureAxis x, y;
  std::vector<FigureSeries> series;

  bool operator==(const Figure&) const = default;
};

/// @throws FormatError where the lengths of a series disagree
std::string to_json(const Figure& figure);

/// @throws FormatError
Figure parse_figure(std::string_view json);

}  // namespace plumbline::reports
