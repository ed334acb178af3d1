// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/built_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "tests/render_node/show/fake_session.h"

namespace aquarama::show {
namespace {

// A driver that takes every call and draws nothing, for as long as this lives.
class BlindDriver {
  public:
    BlindDriver() {
        glDrawArrays = [](GLenum, GLint, GLsizei) {};
    }
    ~BlindDriver() { glDrawArrays = drawn_; }
    BlindDriver(const BlindDriver&) = delete;
    BlindDriver& operator=(const BlindDriver&) = delete;

  private:
    decltype(glDrawArrays) drawn_ = glDrawArrays;
};

TEST(BuiltLook, isRefusedWhereTheDriverDrawsNothing) {
    Events events;
    CountingContext context{events, {480, 360}};
    EXPECT_NO_THROW(BuiltLook(context, "middle", admissionTo(wire::Pattern::Grey)));
    const BlindDriver blind;
    try {
        const BuiltLook look(context, "middle", admissionTo(wire::Pattern::Grey));
        FAIL() << "a black picture counts as a show";
    } catch (const Error& problem) {
        EXPECT_THAT(problem.what(), testing::HasSubstr("the driver draws a black picture ("));
    }
}

// Of what a mask leaves, a strip of ten rows, nothing may be seen in a small copy.
TEST(BuiltLook, isTakenWhereTheChannelLightsNextToNothing) {
    Events events;
    CountingContext context{events, {480, 360}};
    session::Admission admission = admissionTo(wire::Pattern::Grey);
    const std::string mask =
        "masks { channel: \"middle\" picture { x_px: 0 y_px: 0 } picture { x_px: 480 y_px: 0 } "
        "picture { x_px: 480 y_px: 350 } picture { x_px: 0 y_px: 350 } }";
    const auto bytes = std::as_bytes(std::span{mask});
    admission.rig.adjustments = "mask";
    admission.rig.files["mask"] =
        std::make_shared<const net::ByteVector>(bytes.begin(), bytes.end());
    const BlindDriver blind;
    EXPECT_NO_THROW(BuiltLook(context, "middle", std::move(admission)));
}

}  // namespace
}  // namespace aquarama::show
