// SPDX-License-Identifier: Apache-2.0
#include "common/base/worker_pool.h"

#include <array>
#include <atomic>

#include <gtest/gtest.h>

namespace aquarama {
namespace {

TEST(WorkerPool, everyChunkOfEveryJobIsDoneOnceBeforeRunReturns) {
    for (const unsigned threads : {1U, 2U, 4U}) {
        WorkerPool pool(threads);
        std::array<std::atomic<int>, 37> done{};
        for (int job = 1; job <= 2000; ++job) {
            const std::size_t chunks = static_cast<std::size_t>(job) % 38;
            for (auto& count : done) count = 0;
            pool.run(chunks, [&](std::size_t chunk) { ++done[chunk]; });
            for (std::size_t chunk = 0; chunk < done.size(); ++chunk)
                ASSERT_EQ(done[chunk], chunk < chunks ? 1 : 0)
                    << threads << " threads, job " << job;
        }
    }
}

}  // namespace
}  // namespace aquarama
