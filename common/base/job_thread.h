// SPDX-License-Identifier: Apache-2.0
// Work that must hold up nobody, such as writing to a disk: jobs on a thread of their own.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace aquarama {

// Does jobs one after the other, in the order in which they are given.
class JobThread {
  public:
    using Job = std::function<void()>;  // must not throw

    // `name`: of the thread, for debuggers. `mostBytes`: of what jobs hold while they wait.
    // `onIdle` is called on the thread whenever no job waits any more.
    JobThread(
        std::string name, std::size_t mostBytes, Job onIdle = [] {});
    // Does what waits.
    ~JobThread();
    JobThread(const JobThread&) = delete;
    JobThread& operator=(const JobThread&) = delete;

    // From any thread. `bytes`: what the job holds. False: too much waits, the job is not taken.
    bool put(std::size_t bytes, Job job);
    // Returns when all jobs that were given are done.
    void finish();

  private:
    struct Waiting {
        std::size_t bytes = 0;
        Job job;
    };
    void run();

    std::string name_;
    std::size_t mostBytes_;
    Job onIdle_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Waiting> waiting_;
    std::size_t bytes_ = 0;  // of those that wait, and of the one that is done now
    bool isIdle_ = true, isStopped_ = false;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace aquarama
