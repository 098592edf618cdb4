#include "metrics/cluster_bootstrap.h"

#include <gtest/gtest.h>

#include <vector>

#include "metrics/summary.h"

namespace fracbench {
namespace {

using Clusters = std::vector<std::vector<double>>;

// Values that share an offset within their cluster: mean 0, correlated.
Clusters clustered_data(Random& random, int clusters, int size) {
  Clusters data(clusters);
  for (auto& cluster : data) {
    const double offset = random.normal();
    for (int i = 0; i < size; ++i) cluster.push_back(offset + 0.5 * random.normal());
  }
  return data;
}

ClusterStatistic mean_of(const Clusters& data) {
  return [&data](std::span<const std::size_t> chosen) -> std::optional<double> {
    std::vector<double> values;
    for (const std::size_t c : chosen) {
      values.insert(values.end(), data[c].begin(), data[c].end());
    }
    if (values.empty()) return std::nullopt;
    return summarize(values).mean;
  };
}

Clusters as_single_values(const Clusters& data) {
  Clusters single;
  for (const auto& cluster : data) {
    for (const double value : cluster) single.push_back({value});
  }
  return single;
}

// Share of 95 % intervals that hold the true mean 0.
double coverage(const auto& regroup, bool corrected) {
  int held = 0;
  const int rounds = 300;
  for (int round = 0; round < rounds; ++round) {
    Random random(derive_seed(99, {std::to_string(round)}));
    const Clusters data = regroup(clustered_data(random, 40, 8));
    const auto interval = cluster_bootstrap(data.size(), mean_of(data),
                                            {.resamples = 400, .corrected = corrected}, random);
    held += interval->low <= 0 && 0 <= interval->high ? 1 : 0;
  }
  return static_cast<double>(held) / rounds;
}

TEST(ClusterBootstrap, intervals_hold_the_truth_as_often_as_they_claim) {
  for (const bool corrected : {false, true}) {
    const double share = coverage([](Clusters data) { return data; }, corrected);
    EXPECT_GT(share, 0.90) << corrected;
    EXPECT_LT(share, 0.98) << corrected;
  }
}

TEST(ClusterBootstrap, drawing_single_values_instead_of_clusters_is_far_too_sure) {
  EXPECT_LT(coverage(as_single_values, false), 0.65);
}

TEST(ClusterBootstrap, width_of_the_mean_is_that_of_the_cluster_means) {
  Random random(4);
  const Clusters data = clustered_data(random, 400, 5);
  const auto interval = cluster_bootstrap(data.size(), mean_of(data), {}, random);
  // Standard error sqrt((1 + 0.25 / 5) / 400), 95 %.
  const double expected = 2 * 1.96 * std::sqrt(1.05 / 400);
  EXPECT_NEAR(interval->high - interval->low, expected, 0.12 * expected);
  EXPECT_EQ(interval->resamples, 2000);
  EXPECT_LT(interval->low, interval->estimate);
  EXPECT_GT(interval->high, interval->estimate);
}

TEST(ClusterBootstrap, drawing_fewer_clusters_than_there_are_gives_the_same_width) {
  Random random(5);
  const Clusters data = clustered_data(random, 4000, 3);
  const auto all =
      cluster_bootstrap(data.size(), mean_of(data), {.most_clusters = data.size()}, random);
  const auto few = cluster_bootstrap(data.size(), mean_of(data), {.most_clusters = 200}, random);
  EXPECT_EQ(few->estimate, all->estimate);
  // The standard error of a quantile of 2000 resamples is 3 % of the width.
  EXPECT_NEAR((few->high - few->low) / (all->high - all->low), 1, 0.1);
  EXPECT_NEAR(few->high + few->low, all->high + all->low, 0.2 * (all->high - all->low));
}

TEST(ClusterBootstrap, costs_no_more_for_more_clusters) {
  for (const std::size_t clusters : {1000, 100000}) {
    Random random(1);
    std::size_t drawn = 0;
    const ClusterStatistic count = [&](std::span<const std::size_t> chosen) {
      drawn += chosen.size();
      return std::optional(static_cast<double>(chosen.front()));
    };
    cluster_bootstrap(clusters, count, {.resamples = 100}, random);
    EXPECT_EQ(drawn, clusters + 100 * BootstrapOptions().most_clusters);
  }
}

TEST(ClusterBootstrap, same_seed_gives_the_same_interval) {
  Random random(4);
  const Clusters data = clustered_data(random, 20, 5);
  Random first(17);
  Random second(17);
  Random third(18);
  const auto a = cluster_bootstrap(data.size(), mean_of(data), {}, first);
  const auto b = cluster_bootstrap(data.size(), mean_of(data), {}, second);
  const auto c = cluster_bootstrap(data.size(), mean_of(data), {}, third);
  EXPECT_EQ(a->low, b->low);
  EXPECT_EQ(a->high, b->high);
  EXPECT_NE(a->low, c->low);
}

TEST(ClusterBootstrap, correction_moves_the_interval_of_a_skewed_statistic_towards_its_tail) {
  Random random(6);
  Clusters data(30);
  for (auto& cluster : data) {
    const double x = random.normal();
    cluster.push_back(x * x * x * x);
  }
  Random first(1);
  Random second(1);
  const auto plain = cluster_bootstrap(data.size(), mean_of(data), {.corrected = false}, first);
  const auto corrected = cluster_bootstrap(data.size(), mean_of(data), {}, second);
  EXPECT_GT(corrected->high, plain->high);
  EXPECT_GT(corrected->low, plain->low);
}

TEST(ClusterBootstrap, does_not_answer_where_nothing_can_be_said) {
  Random random(1);
  const Clusters one{{1, 2, 3}};
  EXPECT_FALSE(cluster_bootstrap(1, mean_of(one), {}, random).has_value());
  EXPECT_FALSE(cluster_bootstrap(0, mean_of({}), {}, random).has_value());
  const Clusters empty(5);
  EXPECT_FALSE(cluster_bootstrap(5, mean_of(empty), {}, random).has_value());
  // With one filled cluster of two, a quarter of the resamples are empty; the rest counts.
  const Clusters half{{1, 2, 3}, {}};
  const auto interval = cluster_bootstrap(2, mean_of(half), {.resamples = 400}, random);
  ASSERT_TRUE(interval.has_value());
  EXPECT_NEAR(interval->resamples, 300, 40);
  EXPECT_EQ(interval->low, 2);
  EXPECT_EQ(interval->high, 2);
}

TEST(ClusterBootstrap, joint_intervals_are_those_of_each_statistic_on_the_same_resamples) {
  Random draw(8);
  Clusters data = clustered_data(draw, 25, 4);
  for (std::size_t c = 0; c < data.size(); c += 3) data[c].clear();
  const ClusterStatistic mean = mean_of(data);
  // Exists only where the first cluster with values was drawn.
  const ClusterStatistic rare = [](std::span<const std::size_t> chosen) -> std::optional<double> {
    std::size_t times = 0;
    for (const std::size_t c : chosen) times += c == 1;
    return times > 0 ? std::optional(static_cast<double>(times)) : std::nullopt;
  };
  const ClusterStatistic never = [](auto) -> std::optional<double> { return std::nullopt; };
  const ClusterStatistics all = [&](std::span<const std::size_t> chosen) {
    return std::vector{mean(chosen), rare(chosen), never(chosen)};
  };
  for (const std::size_t most : {std::size_t{500}, std::size_t{10}}) {
    const BootstrapOptions options{.resamples = 300, .most_clusters = most};
    Random random(9);
    const auto joint = joint_cluster_bootstrap(data.size(), all, options, random);
    ASSERT_EQ(joint.size(), 3u);
    EXPECT_FALSE(joint[2].has_value());
    for (const int k : {0, 1}) {
      Random same(9);
      const auto alone = cluster_bootstrap(data.size(), k == 0 ? mean : rare, options, same);
      ASSERT_EQ(joint[k].has_value(), alone.has_value());
      if (!alone) continue;
      EXPECT_EQ(joint[k]->estimate, alone->estimate);
      EXPECT_EQ(joint[k]->low, alone->low);
      EXPECT_EQ(joint[k]->high, alone->high);
      EXPECT_EQ(joint[k]->resamples, alone->resamples);
    }
  }
}

}  // namespace
}  // namespace fracbench
