#include "pairs/halves_ahead.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "pairs/batches.h"
#include "pairs/cell_fit.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kMostAhead = 256;

}  // namespace

std::vector<std::size_t> CellQueue::first(std::size_t count,
                                          const std::vector<TreeCell>& cells) const {
  std::vector<value_type> top(std::min(count, size()));
  std::partial_sort_copy(c.begin(), c.end(), top.begin(), top.end(), std::greater<>());
  std::vector<std::size_t> first;
  for (const auto& [key, index] : top) {
    if (cells[index].halves == 0) first.push_back(index);
  }
  return first;
}

std::array<Box, 2> halves_of(const TreeCell& cell) {
  std::array<Box, 2> halves{cell.box, cell.box};
  halves[0].high[cell.cut] = halves[1].low[cell.cut] = cell.at;
  return halves;
}

bool HalvesAhead::knows(std::size_t index, const TreeCell& cell) const {
  const auto known = known_.find(index);
  return known != known_.end() && known->second.cut == cell.cut && known->second.at == cell.at;
}

std::vector<double> HalvesAhead::take(std::size_t index, const std::vector<TreeCell>& cells,
                                      const CellQueue& queue) {
  if (!knows(index, cells[index])) {
    std::vector<std::size_t> asked{index};
    for (const std::size_t i : queue.first(ahead_, cells)) {
      if (i != index && !knows(i, cells[i])) asked.push_back(i);
    }
    ask_for(asked, cells);
  }
  std::vector<double> values = std::move(known_[index].values);
  known_.erase(index);
  return values;
}

void HalvesAhead::ask_for(const std::vector<std::size_t>& asked,
                          const std::vector<TreeCell>& cells) {
  std::vector<Point2> points;
  for (const std::size_t i : asked) {
    for (const Box& half : halves_of(cells[i])) CellFit::add_points(half, dimension_, points);
  }
  const std::vector<double> values = ask(integrand_, points);
  const auto each = static_cast<std::ptrdiff_t>(2 * CellFit::points(dimension_));
  auto first = values.begin();
  for (const std::size_t i : asked) {
    known_[i] = {cells[i].cut, cells[i].at, {first, first + each}};
    first += each;
  }
  const bool in_spans = integrand_.batch() > Many<double(Point2)>::kOneByOne;
  if (in_spans) ahead_ = std::min(std::max<std::size_t>(2 * ahead_, 1), kMostAhead);
}

}  // namespace plumbline::verify
