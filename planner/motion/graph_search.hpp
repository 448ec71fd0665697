// The one search for shortest ways: over the lattice of a map, a roadmap, or corners of boxes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "planner/motion/config.hpp"

namespace gnbv {

using GraphNode = std::uint32_t;
constexpr GraphNode kNoNode = 0xffffffffU;

/// What a search has found out about each node.
template <typename Length>
struct Ways {
  std::vector<Length> length_m;       // of the shortest way there; infinite: none is known
  std::vector<GraphNode> before;      // the node before it on that way; of the start the start
  std::vector<std::uint8_t> is_done;  // the length is final

  void grow(std::size_t nodes) {
    if (nodes <= length_m.size()) return;
    length_m.resize(nodes, std::numeric_limits<Length>::infinity());
    before.resize(nodes, kNoNode);
    is_done.resize(nodes, 0);
  }
};

/// What a search does with the node that it has come to.
enum class AtNode { expand, skip, put_back, stop };

/// Shortest ways from a node (A*: Hart, Nilsson, Raphael 1968; Dijkstra 1959 where nothing is known
/// of what remains). The graph says
///   rest_m(node): what remains from there at least, 0 where that is not known;
///   rank(node): of equally promising nodes the one with the lower rank comes first;
///   come_to(node, found_m): what to do at a node that is reached by a way of that length; put_back
///     when the graph has just found the way to be longer;
///   visit(node, use): calls use(before, next, leg_m) for each leg on from there;
///   may_fly(node, next): whether that leg may be flown, asked where it would make a way shorter.
template <typename Length, typename Graph>
void find_ways(Graph& graph, GraphNode from, Ways<Length>& ways, const HeedStop& stop) {
  struct Open {
    Length estimate_m;  // of the whole way by this node
    std::uint64_t rank;
    GraphNode node;
    bool operator<(const Open& other) const {  // the top of the queue is the least of all
      return estimate_m != other.estimate_m ? estimate_m > other.estimate_m : rank > other.rank;
    }
  };
  std::priority_queue<Open> open;
  const auto estimate_m = [&](GraphNode node) { return ways.length_m[node] + graph.rest_m(node); };
  const auto reach = [&](GraphNode node) { open.push({estimate_m(node), graph.rank(node), node}); };
  ways.grow(from + std::size_t{1});
  ways.length_m[from] = Length{0};
  ways.before[from] = from;
  reach(from);
  while (!open.empty()) {
    heed(stop);
    const auto [found_m, rank, nearest] = open.top();
    const GraphNode node = nearest;  // clang 14 captures no binding
    open.pop();
    if (ways.is_done[node] != 0 || found_m > estimate_m(node)) continue;
    const AtNode next_step = graph.come_to(node, found_m);
    if (next_step == AtNode::stop) return;
    if (next_step == AtNode::put_back) reach(node);
    if (next_step != AtNode::expand) continue;
    ways.is_done[node] = 1;
    graph.visit(node, [&](GraphNode before, GraphNode next, Length leg_m) {
      ways.grow(next + std::size_t{1});
      const Length next_m = ways.length_m[before] + leg_m;
      if (ways.is_done[next] != 0 || next_m >= ways.length_m[next]) return;
      if (!graph.may_fly(node, next)) return;
      ways.length_m[next] = next_m;
      ways.before[next] = before;
      reach(next);
    });
  }
}

/// The points of the way's nodes after `from`, up to `last`; none where they are one. `p_m(node)`:
/// where a node is.
template <typename Length, typename PointOf>
std::vector<Vec3> points_on_way(const Ways<Length>& ways, GraphNode from, GraphNode last,
                                const PointOf& p_m) {
  std::vector<Vec3> points_m;
  for (GraphNode at = last; at != from; at = ways.before[at]) points_m.push_back(p_m(at));
  std::reverse(points_m.begin(), points_m.end());
  return points_m;
}

}  // namespace gnbv
