#include "metrics/partition_agreement.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/maximum_weighted_matching.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "core/adjusted_rand_index.h"

namespace fracbench {

namespace {

double conditional_entropies(const Contingency& counts) {
  double bits = 0;
  for (const auto& [pair, count] : counts.both) {
    const auto n = static_cast<double>(count);
    const auto of_a = static_cast<double>(counts.a.at(pair.first));
    const auto of_b = static_cast<double>(counts.b.at(pair.second));
    bits -= n / static_cast<double>(counts.all) * (std::log2(n / of_a) + std::log2(n / of_b));
  }
  return bits;
}

double matched_overlap(const Contingency& counts) {
  using Graph =
      boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                            boost::property<boost::edge_weight_t, Contingency::Count>>;
  std::map<std::int32_t, std::size_t> node_of_a;
  std::map<std::int32_t, std::size_t> node_of_b;
  for (const auto& [label, count] : counts.a) node_of_a.emplace(label, node_of_a.size());
  for (const auto& [label, count] : counts.b) {
    node_of_b.emplace(label, node_of_a.size() + node_of_b.size());
  }
  Graph graph(node_of_a.size() + node_of_b.size());
  for (const auto& [pair, count] : counts.both) {
    boost::add_edge(node_of_a[pair.first], node_of_b[pair.second], count, graph);
  }
  std::vector<Graph::vertex_descriptor> mate(boost::num_vertices(graph));
  boost::maximum_weighted_matching(graph, mate.data());
  double sum = 0;
  for (const auto& [pair, count] : counts.both) {
    if (mate[node_of_a[pair.first]] != node_of_b[pair.second]) continue;
    const Contingency::Count of_a = counts.a.at(pair.first);
    const Contingency::Count joined = of_a + counts.b.at(pair.second) - count;
    sum += static_cast<double>(of_a) * static_cast<double>(count) / static_cast<double>(joined);
  }
  return sum / static_cast<double>(counts.all);
}

}  // namespace

PartitionAgreement partition_agreement(std::span<const std::int32_t> a,
                                       std::span<const std::int32_t> b) {
  const Contingency counts = contingency(a, b);
  PartitionAgreement agreement{.adjusted_rand = adjusted_rand_index(counts)};
  if (counts.all == 0) return agreement;
  // Rounding may leave a little less than none.
  agreement.variation_of_information = std::max(conditional_entropies(counts), 0.0);
  agreement.matched_iou = matched_overlap(counts);
  return agreement;
}

}  // namespace fracbench
