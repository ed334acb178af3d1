// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/school_records.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "render_node/shaders/shader_interface.h"

namespace aquarama::surface {

namespace {

// Layout of the traits in fish_record.glsl.
struct Traits {
    std::uint32_t id, lengthMillimetres;
};

std::vector<Traits> traitsOf(std::span<const SchoolSpecies> cast) {
    std::vector<Traits> traits;
    for (const SchoolSpecies& species : cast)
        for (const motion::FishTraits& fish : species.fish)
            traits.push_back({fish.id, fish.lengthMillimetres});
    return traits;
}

}  // namespace

SchoolRecords::SchoolRecords(std::span<const SchoolSpecies> cast) {
    for (const SchoolSpecies& species : cast) fish_ += species.fish.size();
    const std::size_t bytes = fish_ * sizeof(motion::FishRecord);
    before_.records = gl::makeBuffer(bytes, "fish before", GL_DYNAMIC_STORAGE_BIT);
    after_.records = gl::makeBuffer(bytes, "fish after", GL_DYNAMIC_STORAGE_BIT);
    traits_ = gl::makeBuffer(traitsOf(cast), "traits");
}

void SchoolRecords::update(const SchoolMoment& moment) {
    assert(moment.fraction >= 0.0F);
    assert(moment.fraction <= 1.0F);
    uploaded_ = std::min(moment.after.size(), fish_);
    isBetween_ = moment.before.size() == moment.after.size();
    fraction_ = isBetween_ ? moment.fraction : 1.0F;
    std::optional<Tick> before;
    if (moment.tick && moment.tick->value > 0) before = Tick{moment.tick->value - 1};
    if (before && after_.tick == before) std::swap(before_, after_);
    upload(after_, moment.after, moment.tick);
    if (isBetween_) upload(before_, moment.before, before);
}

void SchoolRecords::upload(Uploaded& to,
                           std::span<const motion::FishRecord> records,
                           std::optional<Tick> tick) const {
    const std::size_t count = std::min(records.size(), fish_);
    if (count == 0 || (tick && to.tick == tick)) return;
    to.tick = tick;
    const auto bytes = static_cast<GLsizeiptr>(count * sizeof(motion::FishRecord));
    glNamedBufferSubData(to.records.name(), 0, bytes, records.data());
}

// Without a record of the tick before, the frame shows the later tick.
void SchoolRecords::bind() const {
    gl::bindStorage(shaders::kBeforeStorage, isBetween_ ? before_.records : after_.records);
    gl::bindStorage(shaders::kAfterStorage, after_.records);
    gl::bindStorage(shaders::kTraitsStorage, traits_);
}

}  // namespace aquarama::surface
