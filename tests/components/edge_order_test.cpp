#include "components/edge_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace pleat {
namespace {

/// A sheet of rows and columns with one diagonal a square; its particles are numbered at random.
struct Sheet {
  std::uint32_t rows, columns;
  std::vector<std::uint32_t> number;
  std::vector<EdgeEnds> edges;

  Sheet(std::uint32_t r, std::uint32_t c) : rows(r), columns(c), number(std::size_t{r} * c) {
    std::iota(number.begin(), number.end(), 0u);
    std::shuffle(number.begin(), number.end(), std::mt19937(7));
    for (std::uint32_t i = 0; i < rows; ++i) {
      for (std::uint32_t j = 0; j < columns; ++j) {
        if (j + 1 < columns) add(i, j, i, j + 1);
        if (i + 1 < rows) add(i, j, i + 1, j);
        if (i + 1 < rows && j + 1 < columns) add(i, j, i + 1, j + 1);
      }
    }
  }
  std::uint32_t at(std::uint32_t row, std::uint32_t column) const { return number[row * columns + column]; }
  std::uint32_t row_of(std::uint32_t particle) const {
    const auto place = std::find(number.begin(), number.end(), particle) - number.begin();
    return static_cast<std::uint32_t>(place) / columns;
  }
  std::vector<std::uint32_t> first_row() const { return {number.begin(), number.begin() + columns}; }

 private:
  void add(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) {
    edges.push_back({std::min(at(i, j), at(k, l)), std::max(at(i, j), at(k, l))});
  }
};

/// Runs of edges that share no particle, as long as they last.
std::size_t count_runs(const std::vector<EdgeEnds>& edges) {
  std::size_t runs = 1;
  std::set<std::uint32_t> met;
  for (const EdgeEnds& edge : edges) {
    if (met.contains(edge[0]) || met.contains(edge[1])) met.clear(), ++runs;
    met.insert(edge.begin(), edge.end());
  }
  return runs;
}

TEST(EdgeOrder, KeepsEveryEdgeOnce) {
  Sheet sheet(6, 9);
  std::vector<EdgeEnds> ordered = sheet.edges;
  order_edges(54, sheet.first_row(), ordered);
  std::sort(ordered.begin(), ordered.end());
  std::sort(sheet.edges.begin(), sheet.edges.end());
  EXPECT_EQ(ordered, sheet.edges);
}

TEST(EdgeOrder, GoesFromThePinsDownWhateverTheNumbers) {
  Sheet sheet(8, 12);
  order_edges(96, sheet.first_row(), sheet.edges);
  std::uint32_t last = 0;
  for (const auto& [i, j] : sheet.edges) {
    const std::uint32_t row = std::min(sheet.row_of(i), sheet.row_of(j)), across = sheet.row_of(i) == sheet.row_of(j);
    EXPECT_GE(row + across, last);  // a row's own edges with those that lead on from the next
    last = row + across;
  }
  EXPECT_EQ(last, 8u);
  EXPECT_LE(count_runs(sheet.edges), 8u * 7);  // a particle has at most six edges, four of them in one band
}

TEST(EdgeOrder, SlotsKeepEdgesThatMeetInOrderAndAreNearlyFull) {
  Sheet sheet(16, 24);
  order_edges(384, sheet.first_row(), sheet.edges);
  const std::vector<std::uint32_t> slots = slots_of(384, sheet.edges, 8);
  ASSERT_EQ(slots.size() % 8, 0u);
  EXPECT_LT(slots.size(), sheet.edges.size() * 9 / 8);
  std::vector<std::size_t> run_of(sheet.edges.size(), slots.size());
  for (std::size_t s = 0; s < slots.size(); ++s) {
    if (slots[s] == kEmptySlot) continue;
    EXPECT_EQ(run_of[slots[s]], slots.size()) << "twice";
    run_of[slots[s]] = s / 8;
  }
  for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
    ASSERT_LT(run_of[e], slots.size() / 8) << "missing";
    for (std::size_t later = e + 1; later < sheet.edges.size(); ++later) {
      const auto [i, j] = sheet.edges[e];
      const auto [k, l] = sheet.edges[later];
      const bool meet = i == k || i == l || j == k || j == l;
      EXPECT_TRUE(!meet || run_of[e] < run_of[later]);
    }
  }
}

/// How many things wait for each other at most, one after the other: each a few of `edges`, in order.
std::uint32_t longest_wait(std::uint32_t particles, const std::vector<std::vector<EdgeEnds>>& things) {
  std::vector<std::uint32_t> waits(particles);
  for (const std::vector<EdgeEnds>& edges : things) {
    std::uint32_t most = 0;
    for (const auto& [i, j] : edges) most = std::max({most, waits[i], waits[j]});
    for (const auto& [i, j] : edges) waits[i] = waits[j] = most + 1;
  }
  return *std::max_element(waits.begin(), waits.end());
}

TEST(EdgeOrder, RunsWaitForEachOtherNoMoreThanTheirEdgesHaveTo) {
  for (const std::uint32_t columns : {5u, 16u, 40u}) {
    Sheet sheet(6, columns);
    order_edges(6 * columns, sheet.first_row(), sheet.edges);
    std::vector<std::vector<EdgeEnds>> edges, runs;
    for (const EdgeEnds& edge : sheet.edges) edges.push_back({edge});
    const std::vector<std::uint32_t> slots = slots_of(6 * columns, sheet.edges, 8);
    for (std::size_t s = 0; s < slots.size(); ++s) {
      if (s % 8 == 0) runs.emplace_back();
      if (slots[s] != kEmptySlot) runs.back().push_back(sheet.edges[slots[s]]);
    }
    EXPECT_EQ(longest_wait(6 * columns, runs), longest_wait(6 * columns, edges)) << columns;
    EXPECT_LT(runs.size(), (sheet.edges.size() + 7) / 8 + longest_wait(6 * columns, edges)) << columns;
  }
}

TEST(EdgeOrder, WithNowhereToBeginFewRunsTakeTheWholeSheet) {
  Sheet sheet(16, 16);
  order_edges(256, {}, sheet.edges);
  EXPECT_LE(count_runs(sheet.edges), 11u);
}

TEST(EdgeOrder, DoesNotDependOnTheOrderBefore) {
  Sheet sheet(5, 7);
  std::vector<EdgeEnds> shuffled = sheet.edges;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  order_edges(35, sheet.first_row(), sheet.edges);
  order_edges(35, sheet.first_row(), shuffled);
  EXPECT_EQ(shuffled, sheet.edges);
}

TEST(EdgeOrder, AFanOfAHundredAndLoosePartsAreTakenToo) {
  std::vector<EdgeEnds> edges;
  for (std::uint32_t i = 1; i <= 100; ++i) edges.push_back({0, i});
  edges.push_back({101, 102});
  const std::uint32_t pins[] = {3};
  order_edges(103, pins, edges);
  EXPECT_EQ(edges.size(), 101u);
  EXPECT_EQ(edges[0], (EdgeEnds{0, 3}));
  EXPECT_TRUE(std::ranges::count(edges, EdgeEnds{101, 102}) == 1);  // of a part without a pin
  EXPECT_EQ(std::set(edges.begin(), edges.end()).size(), 101u);
}

}  // namespace
}  // namespace pleat
