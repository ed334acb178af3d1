// SPDX-License-Identifier: Apache-2.0
// Threads that share out the chunks of one job at a time; between jobs they sleep.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace aquarama {

class WorkerPool {
  public:
    explicit WorkerPool(unsigned threads);  // the caller of run() is one of them; at least 1
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    WorkerPool(WorkerPool&&) = delete;
    WorkerPool& operator=(WorkerPool&&) = delete;

    // Calls work(chunk) once for each of [0, chunks), from any thread in any order, and returns
    // when all are done. A job may not throw. Neither locks nor allocates.
    template <class Work>
    void run(std::size_t chunks, const Work& work) {
        share(chunks, &work, [](const void* job, std::size_t chunk) {
            (*static_cast<const Work*>(job))(chunk);
        });
    }

  private:
    using Call = void (*)(const void* job, std::size_t chunk);
    void share(std::size_t chunks, const void* job, Call call);
    void work();
    void serve();

    std::size_t chunks_ = 0;
    const void* job_ = nullptr;
    Call call_ = nullptr;
    std::atomic<std::size_t> nextChunk_ = 0;
    std::atomic<std::uint32_t> jobs_ = 0;  // counts up when there is one to do, or when to stop
    std::atomic<std::uint32_t> busy_ = 0;  // workers not yet done with it
    std::atomic<bool> stopping_ = false;
    std::vector<std::jthread> workers_;
};

}  // namespace aquarama
