#include "joints/cube_tree.h"

#include "tree_cut.h"

namespace plumbline::verify {

CubeTree::CubeTree(std::span<CubePoint> points, int depth, std::size_t dimension, double resolution)
    : depth_(depth),
      dimension_(dimension),
      resolution_(resolution),
      splits_(std::size_t{1} << depth),
      boxes_(std::size_t{1} << depth) {
  build(points, 1, 0, CubeBox{});
}

void CubeTree::build(std::span<CubePoint> points, std::size_t node, int level, const CubeBox& box) {
  if (level == depth_) {
    boxes_[node - bins()] = box;
    return;
  }
  const std::size_t d = static_cast<std::size_t>(level) % dimension_;
  const TreeCut cut = cut_at_median(points, d, box.low[d], box.high[d], resolution_, node);
  splits_[node] = cut.split;
  CubeBox low = box, high = box;
  low.high[d] = high.low[d] = cut.split;
  build(points.first(cut.middle), 2 * node, level + 1, low);
  build(points.subspan(cut.middle), 2 * node + 1, level + 1, high);
}

std::size_t CubeTree::locate(const CubePoint& p) const {
  std::size_t node = 1, d = 0;
  for (int level = 0; level < depth_; ++level) {
    node = 2 * node + (p[d] < splits_[node] ? 0 : 1);
    d = d + 1 == dimension_ ? 0 : d + 1;
  }
  return node - bins();
}

}  // namespace plumbline::verify
