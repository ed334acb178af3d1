// SPDX-License-Identifier: Apache-2.0
// Visitors' drawings as the master last listed them, and their pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "common/wire/messages.h"
#include "console/console.pb.h"
#include "console/cues/shown.h"

namespace aquarama::console {

// A picture of a drawing. Shared by all who are sent it.
struct SkinPicture {
    std::shared_ptr<const std::string> png;  // null: the master has none
    std::string tag;                         // names its content
};

// A value without clock, thread or socket. Pictures are asked for one at a time: those that wait
// for the crew first, then the newest. Of what exceeds the bound, the oldest have none.
class DrawingBook {
  public:
    static constexpr std::size_t kMostBytes = std::size_t{128} << 20U;  // of all pictures

    // What the master lists, with a picture where it was asked for one.
    void hear(const v1::DrawingsReply& reply);
    // There are none any more.
    void clear();

    // The drawing whose picture is to be asked for; 0: none.
    [[nodiscard]] std::uint32_t wanted();
    // Null where there is none.
    [[nodiscard]] const SkinPicture* picture(std::uint32_t number) const;

    // How many wait and swim, and how many there are in all.
    [[nodiscard]] DrawingCounts counts() const;
    [[nodiscard]] std::size_t size() const;
    // As pages are sent it; `version` grows with every change.
    [[nodiscard]] browser::Drawings message() const;
    [[nodiscard]] std::uint64_t version() const { return version_; }

  private:
    void keep(std::uint32_t number, const std::string& png);
    void makeRoom();
    [[nodiscard]] bool isFull() const { return bytes_ + wire::kMostSkinBytes > kMostBytes; }
    [[nodiscard]] bool isWaiting(std::uint32_t number) const;

    v1::DrawingsReply list_;  // without a picture
    std::map<std::uint32_t, SkinPicture> pictures_;
    std::size_t bytes_ = 0;  // of them
    std::uint64_t version_ = 1;
};

}  // namespace aquarama::console
