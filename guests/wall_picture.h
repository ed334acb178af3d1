// SPDX-License-Identifier: Apache-2.0
// A small picture of the whole wall, put together of those that nodes bring, and what a place of it
// shows.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/ask/picture_hub.h"
#include "common/config/rig.h"
#include "common/net/channels.h"

namespace aquarama::wall {
class Wall;
}

namespace aquarama::guests {

// Width of the picture; its height is in the proportions of the unrolled wall. Its JPEG has at most
// so many bytes.
inline constexpr int kWallPictureWidth = 400;
inline constexpr std::size_t kMostWallPictureBytes = 6 * 1024;

// Where the pixels of channels lie on the picture. Immutable.
class WallMap {
  public:
    // Throws Error where the rig's wall cannot be made. Takes a part of a second.
    explicit WallMap(const config::Rig& rig);

    // Width and height.
    [[nodiscard]] glm::ivec2 sizePixels() const { return size_; }
    // The unit vector, wall frame, from the viewer to what a place shows, as shares of the
    // picture's size from its upper left corner; nothing beside the screen.
    [[nodiscard]] std::optional<glm::vec3> directionAt(glm::vec2 share) const;
    // sRGB codes of the picture, top row first: the light of the channels' pictures (codes
    // likewise, by index of the channel; those that are missing stay dark), added up as on the
    // screen.
    struct ChannelCodes {
        glm::ivec2 sizePixels{};
        std::vector<std::uint8_t> rgb;
    };
    [[nodiscard]] std::vector<std::uint8_t> composed(
        const std::map<std::size_t, ChannelCodes>& channels) const;

  private:
    // A channel that lights a pixel of the picture, and where in its own picture, as shares.
    struct Source {
        std::uint32_t pixel = 0;
        std::uint32_t channel = 0;
        glm::vec2 share{};
    };
    // The channels that light a point of the screen, which a pixel shows.
    void addSources(const wall::Wall& wall,
                    const config::Rig& rig,
                    std::uint32_t pixel,
                    glm::dvec3 point);

    glm::ivec2 size_;
    std::vector<std::optional<glm::vec3>> directions_;  // of pixels
    std::vector<Source> sources_;
};

// The newest picture of a wall, once a second. From any thread.
class WallPicture {
  public:
    // Listens at the rig's guests.picturesAddress. Throws Error where it cannot.
    WallPicture(const config::Rig& rig, const std::optional<net::MasterKeys>& keys);

    // Asks the nodes for new pictures; once a second, while somebody looks.
    void ask();
    // JPEG of at most kMostWallPictureBytes; empty before the first.
    [[nodiscard]] std::string jpeg() const;
    // Grows with each picture.
    [[nodiscard]] std::uint64_t number() const;
    [[nodiscard]] const WallMap& map() const { return map_; }
    // Where it listens, with the port that was chosen.
    [[nodiscard]] std::string address() const { return hub_.address(); }

  private:
    void take(const std::string& channel, const v1::FramePicture& picture);

    std::vector<std::string> channels_;
    WallMap map_;
    mutable std::mutex mutex_;  // guards what follows, up to the hub
    std::map<std::size_t, WallMap::ChannelCodes> pictures_;
    std::string jpeg_;
    std::uint64_t number_ = 0;
    std::uint64_t asked_ = 0;
    ask::PictureHub hub_;  // last: its thread uses all of the above
};

}  // namespace aquarama::guests
