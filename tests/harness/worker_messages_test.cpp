#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/random.h"
#include "harness/data_tree.h"
#include "harness/workers/cell_request.h"
#include "harness/workers/message.h"
#include "harness/workers/output_tail.h"
#include "harness/workers/tree_bytes.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

DataTree some_tree() {
  DataTree tree;
  tree.put("a/number", 0.1);
  tree.put("a/text", std::string_view("\xc3\xa4 text"));
  tree.put("list", std::vector<double>{1, 2, 3, 4, 5, 6}, 3);
  tree.put("texts", std::vector<std::string>{"one", "", "three"});
  tree.put("none", std::vector<double>{}, 3);
  tree.put("faces", std::vector<std::int32_t>{1, -2, 3}, 3);
  tree.put("seed", ~std::uint64_t{0});
  return tree;
}

TEST(TreeBytes, ComeBackAsTheSameTree) {
  EXPECT_EQ(tree_from_bytes(to_bytes(some_tree())), some_tree());
  EXPECT_EQ(tree_from_bytes(to_bytes(DataTree())), DataTree());
}

TEST(TreeBytes, CutShortAnywhereAreNoOtherTree) {
  const std::string bytes = to_bytes(some_tree());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    try {
      EXPECT_NE(tree_from_bytes(std::string_view(bytes).substr(0, length)), some_tree());
    } catch (const DataError&) {
    }
  }
}

TEST(TreeBytes, DamagedAnywhereAreRefusedOrReadWithoutHarm) {
  Random random(1);
  const std::string bytes = to_bytes(some_tree());
  for (int k = 0; k < 20000; ++k) {
    std::string damaged = bytes;
    for (int changes = 0; changes < 3; ++changes) {
      damaged[random.below(bytes.size())] = static_cast<char>(random.below(256));
    }
    try {
      const DataTree tree = tree_from_bytes(damaged);
      for (const auto& [path, array] : tree.arrays()) {
        EXPECT_LE(array.bytes.size(), bytes.size());
      }
    } catch (const DataError&) {
    }
  }
}

TEST(Messages, ArriveInWhateverPiecesTheyCome) {
  std::string stream;
  for (const char* body : {"", "one", "and two"}) {
    stream += to_bytes(Message{MessageKind::refusal, body});
  }
  for (std::size_t step = 1; step <= stream.size(); ++step) {
    MessageReader reader;
    std::vector<std::string> bodies;
    for (std::size_t at = 0; at < stream.size(); at += step) {
      reader.add(std::string_view(stream).substr(at, step));
      while (auto message = reader.next()) bodies.push_back(message->body);
    }
    EXPECT_THAT(bodies, testing::ElementsAre("", "one", "and two")) << step;
    EXPECT_FALSE(reader.in_the_middle());
  }
}

TEST(Messages, OfUnknownKindsOrImpossibleLengthsAreRefused) {
  MessageReader unknown;
  unknown.add(to_bytes(Message{static_cast<MessageKind>(99), "x"}));
  EXPECT_THROW(unknown.next(), DataError);
  std::string header = to_bytes(Message{MessageKind::progress, ""});
  header[4 + 3] = 1;  // 16 MiB of progress
  MessageReader too_long;
  too_long.add(header);
  EXPECT_THROW(too_long.next(), DataError);
}

TEST(OutputTail, KeepsTheLastLinesAsPrintableText) {
  OutputTail tail;
  EXPECT_EQ(tail.last_lines(), "");
  tail.add("one\ntwo\n\nthr");
  tail.add("ee\n");
  EXPECT_EQ(tail.last_lines(), "one | two | three");
  tail.add("4\n5\n6\r\n7\n");
  EXPECT_EQ(tail.last_lines(), "three | 4 | 5 | 6 | 7");
  tail.clear();
  tail.add(std::string("a\0b\x1b[2J\xff\xc3\xa4\xe2\x82", 12));
  EXPECT_EQ(tail.last_lines(), "a b [2J?\xc3\xa4??");
  tail.clear();
  for (int k = 0; k < 100000; ++k) tail.add("\xc3\xa4");
  EXPECT_LT(tail.last_lines().size(), 420);
  EXPECT_TRUE(tail.last_lines().starts_with("...\xc3\xa4"));
}

TEST(CellRequests, GiveAWorkerTheSameCell) {
  const ToyWorld world;
  const Catalog catalog = world.catalog();
  Plan plan = make_plan(toy_suite(catalog), catalog);
  plan.learning_folder = "/somewhere/learning";
  for (PlannedShape& shape : plan.shapes) shape.learning_digest = "digest of " + shape.label;
  for (const Cell& cell : plan.cells) {
    WorkerJob job = decode_job(encode_job(plan, cell, 12345), catalog);
    const Cell received = decode_cell(encode_cell(plan, cell), job.plan);
    EXPECT_EQ(job.memory, 12345);
    EXPECT_EQ(received.key, cell.key);
    EXPECT_EQ(received.seed, cell.seed);
    EXPECT_EQ(received.prepare_seed, cell.prepare_seed);
    EXPECT_EQ(job.plan.methods.at(0).options.values(), plan.methods[cell.method].options.values());
    EXPECT_EQ(job.plan.shapes.at(0).digest, plan.shapes[cell.shape].digest);
    EXPECT_EQ(job.plan.learning_folder, plan.learning_folder);
    EXPECT_EQ(job.plan.shapes[0].learning_digest, plan.shapes[cell.shape].learning_digest);
    EXPECT_EQ(job.plan.shapes[0].shape.notes, plan.shapes[cell.shape].shape.notes);
    EXPECT_EQ(job.plan.shapes[0].shape.mesh.faces, plan.shapes[cell.shape].shape.mesh.faces);
  }
  EXPECT_THROW(decode_job("nonsense", catalog), DataError);
}

}  // namespace
}  // namespace fracbench
