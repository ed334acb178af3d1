// SPDX-License-Identifier: Apache-2.0
// The records of a school on the GPU, between two ticks, as fish_record.glsl reads them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "render_node/gl/handle.h"
#include "render_node/surface/fish_tables.h"

namespace aquarama::surface {

// The school between two ticks, as the wire brings it: at `fraction` (0 to 1) of the way from
// `before` to `after`. Where `before` has another size, the school is shown at `after`.
struct SchoolMoment {
    std::span<const motion::FishRecord> before, after;
    float fraction = 1.0F;
    // Of `after`; `before` is of the tick before. Nothing: they are of this moment alone.
    std::optional<Tick> tick = {};
};

// Owns its GL objects; construct, use and destroy it with the same context current.
class SchoolRecords {
  public:
    explicit SchoolRecords(std::span<const SchoolSpecies> cast);
    // Uploads the records of a frame, but for those of a tick that an earlier frame brought.
    // Records beyond the cast's fish are ignored.
    void update(const SchoolMoment& moment);
    // Binds records and traits as shader storage.
    void bind() const;
    // Fish of the cast.
    [[nodiscard]] std::size_t fish() const { return fish_; }
    // Fish of the last update(), and its fraction.
    [[nodiscard]] std::size_t uploaded() const { return uploaded_; }
    [[nodiscard]] float fraction() const { return fraction_; }

  private:
    struct Uploaded {
        gl::Buffer records;
        std::optional<Tick> tick = {};  // nothing: of none that comes again
    };
    void upload(Uploaded& to,
                std::span<const motion::FishRecord> records,
                std::optional<Tick> tick) const;

    std::size_t fish_ = 0;
    Uploaded before_, after_;
    gl::Buffer traits_;
    std::size_t uploaded_ = 0;
    bool isBetween_ = false;
    float fraction_ = 1.0F;
};

}  // namespace aquarama::surface
