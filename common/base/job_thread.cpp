// SPDX-License-Identifier: Apache-2.0
#include "common/base/job_thread.h"

#include <utility>

#include <pthread.h>

namespace aquarama {

JobThread::JobThread(std::string name, std::size_t mostBytes, Job onIdle)
    : name_{std::move(name)}, mostBytes_{mostBytes}, onIdle_{std::move(onIdle)}, thread_{[this] {
          run();
      }} {}

JobThread::~JobThread() {
    {
        const std::lock_guard lock(mutex_);
        isStopped_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

bool JobThread::put(std::size_t bytes, Job job) {
    {
        const std::lock_guard lock(mutex_);
        if (bytes_ + bytes > mostBytes_) return false;
        bytes_ += bytes;
        waiting_.push_back({bytes, std::move(job)});
    }
    changed_.notify_all();
    return true;
}

void JobThread::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return isIdle_ && waiting_.empty(); });
}

void JobThread::run() {
    pthread_setname_np(pthread_self(), name_.c_str());
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return isStopped_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        const bool isLast = waiting_.empty();
        isIdle_ = false;
        lock.unlock();
        next.job();
        if (isLast) onIdle_();
        lock.lock();
        bytes_ -= next.bytes;
        isIdle_ = true;
        changed_.notify_all();
    }
}

}  // namespace aquarama
