// SPDX-License-Identifier: MIT
#include "core/odometry/map/plane_cells.h"

#include <gtest/gtest.h>

#include <thread>

namespace trajlo {
namespace {

FittedPlane PlaneNumber(int n) {
  FittedPlane plane;
  plane.offset_m = static_cast<float>(n);
  plane.width_m = 1.0F;
  return plane;
}

TEST(PlaneCells, FitsOnceAndAgainWhenThePointsHaveGrownByMoreThanAnEighthAndOne) {
  PlaneCells cells;
  cells.Resize(3);
  for (std::uint32_t first = 5; first <= 124; ++first) {
    int fits = 0;
    const auto ask = [&](std::uint32_t points) {
      return cells.Get(2, 6, points, [&] { return PlaneNumber(++fits); }).offset_m;
    };
    cells.Clear(2);
    EXPECT_EQ(ask(first), 1.0F);
    EXPECT_EQ(ask(first), 1.0F);
    const std::uint32_t last = first + first / 8 + 1;
    EXPECT_EQ(ask(last), 1.0F);
    EXPECT_EQ(ask(last + 1), 2.0F);
    EXPECT_EQ(ask(last + 1), 2.0F);
    EXPECT_EQ(ask(last), 3.0F) << "points were dropped";
  }
}

TEST(PlaneCells, KeepTheSideOfAPlane) {
  PlaneCells cells;
  cells.Resize(1);
  for (std::uint32_t cell = 0; cell < 8; ++cell) {
    const bool is_one_sided = cell % 3 == 0;
    const auto fit = [&] {
      FittedPlane plane = PlaneNumber(1);
      plane.is_one_sided = is_one_sided;
      return plane;
    };
    for (int asked = 0; asked < 2; ++asked) {
      EXPECT_EQ(cells.Get(0, cell, 100 + cell, fit).is_one_sided, is_one_sided);
    }
  }
}

TEST(PlaneCells, KeepsCellsApartAndWhatTheyHoldWhenThereAreMore) {
  PlaneCells cells;
  cells.Resize(10);
  const auto fit = [](int n) { return [n] { return PlaneNumber(n); }; };
  for (std::uint32_t site = 0; site < 10; ++site) {
    for (std::uint32_t cell = 0; cell < 8; ++cell) {
      cells.Get(site, cell, 9, fit(static_cast<int>(10 * site + cell)));
    }
  }
  cells.Resize(10000);
  cells.Clear(4);
  for (std::uint32_t site = 0; site < 10; ++site) {
    for (std::uint32_t cell = 0; cell < 8; ++cell) {
      const auto expected = static_cast<float>(site == 4 ? -1 : static_cast<int>(10 * site + cell));
      EXPECT_EQ(cells.Get(site, cell, 9, fit(-1)).offset_m, expected);
    }
  }
}

TEST(PlaneCells, GivesTheSameToThreadsThatAskAtOnce) {
  PlaneCells cells;
  cells.Resize(200);
  std::vector<std::thread> threads;
  std::array<int, 4> wrong{};
  for (int& of_thread : wrong) {
    threads.emplace_back([&] {
      for (std::uint32_t i = 0; i < 200 * 8; ++i) {
        const FittedPlane plane =
            cells.Get(i / 8, i % 8, 9, [&] { return PlaneNumber(static_cast<int>(i)); });
        of_thread += plane.offset_m != static_cast<float>(i) || !plane.exists();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int count : wrong) EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace trajlo
