// SPDX-License-Identifier: Apache-2.0
#include "common/base/worker_pool.h"

#include <cassert>

namespace aquarama {

WorkerPool::WorkerPool(unsigned threads) {
    for (unsigned i = 1; i < threads; ++i) workers_.emplace_back([this] { serve(); });
}

WorkerPool::~WorkerPool() {
    stopping_ = true;
    ++jobs_;
    jobs_.notify_all();
}

void WorkerPool::share(std::size_t chunks, const void* job, Call call) {
    assert(job != nullptr);
    assert(call != nullptr);
    assert(busy_ == 0);  // neither nested nor from two threads
    chunks_ = chunks;
    job_ = job;
    call_ = call;
    nextChunk_ = 0;
    // Waking the others would cost more than it saves.
    if (workers_.empty() || chunks <= 1) return work();
    busy_ = static_cast<std::uint32_t>(workers_.size());
    ++jobs_;
    jobs_.notify_all();
    work();
    for (std::uint32_t busy = busy_; busy != 0; busy = busy_) busy_.wait(busy);
}

void WorkerPool::work() {
    for (std::size_t chunk = nextChunk_++; chunk < chunks_; chunk = nextChunk_++)
        call_(job_, chunk);
}

void WorkerPool::serve() {
    // Every worker takes part in every job, so it counts the jobs itself: if it read the counter
    // again, that might already be at the next job, and the worker would miss it.
    for (std::uint32_t seen = 0;; ++seen) {
        jobs_.wait(seen);
        if (stopping_) return;
        work();
        if (--busy_ == 0) busy_.notify_all();
    }
}

}  // namespace aquarama
