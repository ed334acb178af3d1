// SPDX-License-Identifier: Apache-2.0
// The patterns of a scan on the wall of a running show.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "common/config/scan.h"

namespace aquarama::scan {

// A running show and the key for it, as for `aquarama set`.
struct ShownOn {
    std::string rig;     // its file
    std::string master;  // control address; empty: the rig's
    std::string key;     // file; empty: the operator's, where the rig needs one
    std::chrono::milliseconds patience = std::chrono::seconds(10);  // of show()
};

// A wall that shows the patterns of a scan.
class PatternWall {
  public:
    virtual ~PatternWall() = default;
    // Returns when all channels show the pattern: the number of the first such frame.
    virtual std::uint64_t show(const config::ScanPattern& pattern) = 0;
    // Throws Error where a channel has stopped showing the pattern since show() returned.
    virtual void confirm() = 0;
};

// Holds the wall from the first pattern until it is destroyed. A thread renews the hold every
// second; when the program dies, the wall returns to the show after three seconds.
class ShownPatterns final : public PatternWall {
  public:
    // Throws Error where the rig or the key cannot be read.
    explicit ShownPatterns(const ShownOn& where);
    ~ShownPatterns() override;
    ShownPatterns(const ShownPatterns&) = delete;
    ShownPatterns& operator=(const ShownPatterns&) = delete;

    // Waits until the nodes of all channels have shown a frame with the pattern. The delay of the
    // projectors is not known. Throws Error: where no master answers; where the wall is black or
    // held by another scan; after `patience`, with the channels that do not show it; after
    // giveBack().
    std::uint64_t show(const config::ScanPattern& pattern) override;
    void confirm() override;
    // Returns the wall to the show. May be called from any thread, more than once.
    void giveBack() noexcept;

  private:
    class Link;
    std::unique_ptr<Link> link_;
};

}  // namespace aquarama::scan
