#include "mamo/common/job_board.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mamo {
namespace {

class JobBoardAt : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, JobBoardAt, testing::Values(1, 2, 3, 8), testing::PrintToStringParamName());

TEST_P(JobBoardAt, EveryResultAskedForIsThere) {
  Executor executor(GetParam());
  JobBoard board;
  std::vector<int> squares(200, -1);
  JobBoard::run(executor, board, [&] {
    std::vector<JobBoard::Handle> jobs;
    for (std::size_t i = 0; i < squares.size(); ++i)
      jobs.push_back(board.post(static_cast<int>(i % 7), [&squares, i](WorkerId, const std::atomic<bool>&) {
        squares[i] = static_cast<int>(i * i);
      }));
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      board.finish(jobs[i]);
      EXPECT_EQ(squares[i], static_cast<int>(i * i));
    }
  });
}

TEST_P(JobBoardAt, JobsMayPostJobs) {
  Executor executor(GetParam());
  JobBoard board;
  std::atomic<int> ran{0};
  JobBoard::run(executor, board, [&] {
    std::vector<JobBoard::Handle> inner(20);
    for (auto& handle : inner) {
      board.finish(board.post(0, [&](WorkerId, const std::atomic<bool>&) {
        handle = board.post(-1, [&ran](WorkerId, const std::atomic<bool>&) { ++ran; });
      }));
      board.finish(handle);
    }
  });
  EXPECT_EQ(ran.load(), 20);
}

TEST_P(JobBoardAt, ADroppedJobIsToldToStop) {
  Executor executor(GetParam());
  JobBoard board;
  std::atomic<bool> begun{false}, stopped{false};
  JobBoard::run(executor, board, [&] {
    const JobBoard::Handle endless = board.post(0, [&](WorkerId, const std::atomic<bool>& cancelled) {
      begun = true;
      while (!cancelled.load()) std::this_thread::yield();
      stopped = true;
    });
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(GetParam() > 1 ? 5 : 0);
    while (!begun && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
    board.drop(endless);
    board.drop(endless);
  });
  EXPECT_EQ(begun.load(), GetParam() > 1);
  EXPECT_EQ(stopped.load(), begun.load());
}

TEST_P(JobBoardAt, WhatAJobThrowsReachesTheOneWhoAsks) {
  Executor executor(GetParam());
  JobBoard board;
  const auto ask = [&] {
    board.finish(board.post(0, [](WorkerId, const std::atomic<bool>&) { throw std::runtime_error("no"); }));
  };
  EXPECT_THROW(JobBoard::run(executor, board, ask), std::runtime_error);
}

TEST_P(JobBoardAt, LeavingEndsTheJobsThatNobodyAskedFor) {
  Executor executor(GetParam());
  JobBoard board;
  std::atomic<int> endless{0};
  JobBoard::run(executor, board, [&] {
    for (int i = 0; i < 50; ++i)
      board.post(0, [&](WorkerId, const std::atomic<bool>& cancelled) {
        while (!cancelled.load()) std::this_thread::yield();
        ++endless;
      });
  });
  EXPECT_LT(endless.load(), 50);
}

TEST(JobBoard, OneWorkerComputesNothingAhead) {
  Executor executor(1);
  JobBoard board;
  std::vector<int> order;
  JobBoard::run(executor, board, [&] {
    for (int urgency : {3, 1, 2})
      board.post(urgency, [&order, urgency](WorkerId, const std::atomic<bool>&) { order.push_back(urgency); });
    board.finish(board.post(9, [&](WorkerId, const std::atomic<bool>&) { order.push_back(9); }));
  });
  EXPECT_EQ(order, std::vector<int>{9});
}

}  // namespace
}  // namespace mamo
