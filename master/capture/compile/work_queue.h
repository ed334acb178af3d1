// SPDX-License-Identifier: Apache-2.0
// Independent jobs shared out over threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace aquarama::capture {

// Calls work(job) once for each of [0, jobs), in that order but from several threads, and returns
// when all are done. Work may not throw.
template <class Work>
void shareOut(std::size_t jobs, unsigned threads, const Work& work) {
    std::atomic<std::size_t> next = 0;
    const auto serve = [&] {
        for (std::size_t job = next++; job < jobs; job = next++) work(job);
    };
    std::vector<std::jthread> workers;
    for (std::size_t i = 1; i < std::min<std::size_t>(threads, jobs); ++i)
        workers.emplace_back(serve);
    serve();
}

}  // namespace aquarama::capture
