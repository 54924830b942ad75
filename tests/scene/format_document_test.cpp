#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <plumbline/renderer/scene_file/load_scene.h>

/// The tables of docs/scene_format.md hold the rows that the reader goes by, and no others.
namespace plumbline::tests {
namespace {

using Row = std::vector<std::string>;  ///< type, property, kind, default, range

const std::filesystem::path kDocument =
    std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "docs/scene_format.md";

/// The cells of a table's line, without the marks of code; none if it is not such a line.
Row cells_of(const std::string& line) {
  Row cells;
  for (std::size_t at = line.find('|'); at != std::string::npos;) {
    const std::size_t end = line.find('|', at + 1);
    if (end == std::string::npos) break;
    std::string cell = line.substr(at + 1, end - at - 1);
    cell.erase(std::remove(cell.begin(), cell.end(), '`'), cell.end());
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
    cells.push_back(cell);
    at = end;
  }
  return cells;
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(", ", at), list.size());
    names.push_back(list.substr(at, end - at));
    at = end + 2;
  }
  return names;
}

/// Rows of the tables that begin with "type, property, kind, default, range". A first cell holds
/// for the rows below it that have none; it may name several types.
std::multiset<Row> documented() {
  const Row header = {"type", "property", "kind", "default", "range"};
  std::ifstream in(kDocument);
  std::multiset<Row> rows;
  bool inside = false;
  std::string types;
  for (std::string line; std::getline(in, line);) {
    Row cells = cells_of(line);
    if (cells.size() <= header.size()) {
      inside = false;
    } else if (std::equal(header.begin(), header.end(), cells.begin())) {
      inside = true;
    } else if (inside && cells[0].rfind("---", 0) != 0) {
      cells.resize(header.size());
      if (!cells[0].empty()) types = cells[0];
      for (const std::string& type : split(types)) {
        cells[0] = type;
        rows.insert(cells);
      }
    }
  }
  return rows;
}

std::multiset<Row> supported() {
  std::multiset<Row> rows;
  for (const char* tag :
       {"integrator", "sensor", "film", "rfilter", "sampler", "bsdf", "shape", "emitter"}) {
    for (const renderer::SupportedType& type : renderer::supported_types(tag)) {
      if (type.properties.empty()) rows.insert({type.name, "", "", "", ""});
      for (const auto& p : type.properties) {
        rows.insert({type.name, p.name, p.kind, p.absent, p.range});
      }
    }
  }
  return rows;
}

std::string without(const std::multiset<Row>& rows, const std::multiset<Row>& others) {
  std::vector<Row> rest;
  std::set_difference(rows.begin(), rows.end(), others.begin(), others.end(),
                      std::back_inserter(rest));
  std::string text;
  for (const Row& row : rest) {
    for (const std::string& cell : row) text += "| " + cell + " ";
    text += "|\n";
  }
  return text;
}

TEST(SceneFormatDocument, TablesHoldTheRowsThatTheReaderGoesBy) {
  EXPECT_GT(supported().size(), 50u);
  EXPECT_EQ(without(supported(), documented()), "") << "not documented";
  EXPECT_EQ(without(documented(), supported()), "") << "documented, but not so";
}

}  // namespace
}  // namespace plumbline::tests
