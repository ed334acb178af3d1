// SPDX-License-Identifier: Apache-2.0
// What the GPU has of the fish: those of the frame, whether they were uploaded for it or before.
#include "render_node/surface/school_records.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "render_node/shaders/shader_interface.h"
#include "tests/render_node/surface/surface_fixture.h"

namespace aquarama::surface {
namespace {

// Three fish whose phase tells the tick.
std::vector<motion::FishRecord> fishAt(std::uint16_t tick) {
    std::vector<motion::FishRecord> fish(3);
    for (motion::FishRecord& one : fish) one.phase = tick;
    return fish;
}

class SchoolRecordsTest : public test::SurfaceTest {
  protected:
    // The phase that the GPU has at a binding.
    static std::uint16_t phaseAt(int binding) {
        GLint buffer = 0;
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, static_cast<GLuint>(binding), &buffer);
        motion::FishRecord first;
        glGetNamedBufferSubData(static_cast<GLuint>(buffer), 0, sizeof(first), &first);
        return first.phase;
    }
    // Shows a moment between two ticks, and looks whether the GPU has those.
    void shows(std::uint16_t before, std::uint16_t after, std::optional<std::uint64_t> tick) {
        const auto one = fishAt(before);
        const auto other = fishAt(after);
        records_.update({one, other, 0.5F, tick ? std::optional(Tick{*tick}) : std::nullopt});
        records_.bind();
    }
    void expect(std::uint16_t before, std::uint16_t after) {
        EXPECT_EQ(phaseAt(shaders::kBeforeStorage), before);
        EXPECT_EQ(phaseAt(shaders::kAfterStorage), after);
    }

    SchoolRecords records_{
        std::vector<SchoolSpecies>{{body_, {}, repertoire_, std::vector<motion::FishTraits>(3)}}};
};

TEST_F(SchoolRecordsTest, haveTheTicksOfEachFrame) {
    for (const std::uint64_t tick : {4U, 5U, 6U, 6U, 9U, 10U, 3U, 0U, 1U}) {
        const auto after = static_cast<std::uint16_t>(100 + tick);
        shows(static_cast<std::uint16_t>(after - 1), after, tick);
        expect(static_cast<std::uint16_t>(after - 1), after);
    }
}

TEST_F(SchoolRecordsTest, takeFromTheFrameOnlyTheTickThatIsNew) {
    shows(103, 104, 4);
    shows(7, 105, 5);  // tick 4 is there already
    expect(104, 105);
    shows(7, 7, 5);
    expect(104, 105);
    shows(7, 107, 7);  // tick 6 is not
    expect(7, 107);
}

TEST_F(SchoolRecordsTest, takeAllOfAFrameWhoseFishWereMoved) {
    shows(103, 104, 4);
    shows(1, 2, {});
    expect(1, 2);
    shows(3, 4, {});
    expect(3, 4);
    shows(104, 105, 5);
    expect(104, 105);
}

TEST_F(SchoolRecordsTest, forgetNoTickWhereAFrameHasNoTickBefore) {
    shows(103, 104, 4);
    const auto fish = fishAt(105);
    records_.update({{}, fish, 1.0F, Tick{5}});
    records_.bind();
    expect(105, 105);
    shows(105, 106, 6);
    expect(105, 106);
}

}  // namespace
}  // namespace aquarama::surface
