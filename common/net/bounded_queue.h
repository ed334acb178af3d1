// SPDX-License-Identifier: Apache-2.0
// A queue between two threads, of bounded length.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace aquarama::net {

// One thread puts, one takes; a queue that is full holds up or refuses whoever puts. The lock is
// held for a move only, never across a call into a socket or a driver.
template <class T>
class BoundedQueue {
  public:
    explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

    // Waits while the queue is full. False: it was closed, nothing is put any more.
    bool put(T item) {
        std::unique_lock lock(mutex_);
        space_.wait(lock, [&] { return closed_ || items_.size() < capacity_; });
        if (closed_) return false;
        items_.push_back(std::move(item));
        return true;
    }

    // False: full or closed.
    bool tryPut(T item) {
        const std::lock_guard lock(mutex_);
        if (closed_ || items_.size() >= capacity_) return false;
        items_.push_back(std::move(item));
        return true;
    }

    // For the thread that puts: once false, it stays false until that thread puts again.
    [[nodiscard]] bool full() const {
        const std::lock_guard lock(mutex_);
        return items_.size() >= capacity_;
    }

    // The oldest; empty where there is none. Also after close(), until nothing is left.
    std::optional<T> tryTake() {
        const std::lock_guard lock(mutex_);
        if (items_.empty()) return std::nullopt;
        std::optional<T> first = std::move(items_.front());
        items_.pop_front();
        space_.notify_one();
        return first;
    }

    // Ends every wait; nothing is put from now on.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        space_.notify_all();
    }

  private:
    mutable std::mutex mutex_;
    std::condition_variable space_;
    std::deque<T> items_;
    std::size_t capacity_;
    bool closed_ = false;
};

}  // namespace aquarama::net
