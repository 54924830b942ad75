#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumbline::reports {

/// A table on the page, its cells as they are to be read. JSON format "plumbline.table/1".
struct Table {
  std::string group;  ///< heading it stands under, with the figures of that group
  std::string title;
  std::string caption;  ///< what to look for
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`

  bool operator==(const Table&) const = default;
};

/// @throws FormatError where a row is not as long as the columns
std::string to_json(const Table& table);

/// @throws FormatError
Table parse_table(std::string_view json);

}  // namespace plumbline::reports
