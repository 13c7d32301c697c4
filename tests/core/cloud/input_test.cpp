// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/input.h"

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(Input, HandsOutEveryByteOnceWhateverTheChunk) {
  const std::string text = "The quick brown fox jumps over the lazy dog";
  for (const std::size_t chunk : {1U, 3U, 16U, 1000U}) {
    Input input = Input::from_memory(text, "m", chunk);
    std::string seen;
    for (;;) {
      EXPECT_EQ(input.remaining(), text.size() - seen.size());
      if (input.rest().empty() && !*input.more()) break;
      const std::size_t take = std::min<std::size_t>(2, input.rest().size());
      seen += input.rest().substr(0, take);
      input.consume(take);
    }
    EXPECT_EQ(seen, text) << chunk;
  }
}

TEST(Input, RequireGrowsTheBufferAndSkipCrossesChunks) {
  const std::string text(1000, 'a');
  Input input = Input::from_memory(text, "m", 8);
  EXPECT_TRUE(*input.require(100));
  EXPECT_GE(input.rest().size(), 100U);
  EXPECT_TRUE(*input.skip(900));
  EXPECT_EQ(input.remaining(), 100U);
  EXPECT_FALSE(*input.skip(101));
  EXPECT_FALSE(*input.require(101));
  EXPECT_TRUE(*input.require(100));
}

}  // namespace
}  // namespace lvcalib
