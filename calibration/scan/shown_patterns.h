// SPDX-License-Identifier: Apache-2.0
// The patterns of a scan on the wall of a running show.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "common/config/scan.h"

namespace aquarama::scan {

// Which show, and with whose key, as `aquarama set` has them.
struct ShownOn {
    std::string rig;     // its file
    std::string master;  // control address; empty: the rig's
    std::string key;     // file; empty: the operator's, where the rig needs one
    std::chrono::milliseconds patience = std::chrono::seconds(10);  // of show()
};

// What shows the patterns of a scan.
class PatternWall {
  public:
    virtual ~PatternWall() = default;
    // Returns when all channels show it: the number of the frame from which on they do.
    virtual std::uint64_t show(const config::ScanPattern& pattern) = 0;
    // Throws Error where a channel has not shown it any more since show() has returned.
    virtual void confirm() = 0;
};

// Holds the wall from the first pattern until it is destroyed, and says so every second on a thread
// of its own; a program that dies leaves the wall to the show three seconds later.
class ShownPatterns final : public PatternWall {
  public:
    // Throws Error where the rig or the key cannot be read.
    explicit ShownPatterns(const ShownOn& where);
    ~ShownPatterns() override;
    ShownPatterns(const ShownPatterns&) = delete;
    ShownPatterns& operator=(const ShownPatterns&) = delete;

    // Waits until the nodes of all channels of the rig have shown a frame with the pattern. What a
    // projector itself delays is not known. Throws Error: no master answers, the wall is black or
    // held by another scan, or after `patience`, naming the channels that do not show it; after
    // giveBack().
    std::uint64_t show(const config::ScanPattern& pattern) override;
    void confirm() override;
    // The wall shows what it did before. From any thread, once or more often.
    void giveBack() noexcept;

  private:
    class Link;
    std::unique_ptr<Link> link_;
};

}  // namespace aquarama::scan
