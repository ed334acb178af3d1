// SPDX-License-Identifier: Apache-2.0
// Threads that share the chunks of one job at a time; between jobs they sleep.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace aquarama {

// Owns its threads from construction to destruction. run() may be called by one thread at a time
// and not from within a job.
class WorkerPool {
  public:
    // threads counts the caller of run() too, so one less is started; 0 is taken as 1.
    explicit WorkerPool(unsigned threads);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    WorkerPool(WorkerPool&&) = delete;
    WorkerPool& operator=(WorkerPool&&) = delete;

    // Calls work(chunk) once for each of [0, chunks), from any thread in any order, and returns
    // when all are done; what the job wrote is then visible to the caller. A job may not throw.
    // Neither locks nor allocates.
    template <class Work>
    void run(std::size_t chunks, const Work& work) {
        share(chunks, &work, [](const void* job, std::size_t chunk) {
            (*static_cast<const Work*>(job))(chunk);
        });
    }

  private:
    using Call = void (*)(const void* job, std::size_t chunk);
    // The job without its type; work() runs chunks until none is left; serve() is the loop of a
    // worker.
    void share(std::size_t chunks, const void* job, Call call);
    void work();
    void serve();

    // The job under way: written by share() before it wakes the workers.
    std::size_t chunks_ = 0;
    const void* job_ = nullptr;
    Call call_ = nullptr;
    std::atomic<std::size_t> nextChunk_ = 0;
    // Counts up when there is a job to do, and when to stop; workers wait on it.
    std::atomic<std::uint32_t> jobs_ = 0;
    // Workers that are not yet done with the job; the caller waits on it.
    std::atomic<std::uint32_t> busy_ = 0;
    std::atomic<bool> stopping_ = false;
    std::vector<std::jthread> workers_;
};

}  // namespace aquarama
