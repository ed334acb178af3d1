// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "render_node/gl/context.h"

namespace aquarama::gl {
namespace {

std::string refusalOf(const std::string& device) {
    try {
        (void)makeOffscreenContext(device, {16, 16});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(OffscreenContext, isOpenGl45) {
    const auto context = makeOffscreenContext("auto", {320, 200});
    int major = 0;
    int minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    EXPECT_GE(major * 10 + minor, 45);
    EXPECT_EQ(context->framebufferPixels(), glm::ivec2(320, 200));
    EXPECT_FALSE(context->hasWindow());
}

TEST(OffscreenContext, ofEveryKindThatMesaOffers) {
    for (const char* device : {"auto", "mesa", "surfaceless", "device:0"})
        EXPECT_EQ(refusalOf(device), "") << device;
}

TEST(OffscreenContext, aDeviceThatIsNotThereIsNamed) {
    EXPECT_THAT(
        refusalOf("device:99"),
        testing::AllOf(testing::HasSubstr("device:99"), testing::HasSubstr("numbered from 0")));
    for (const char* nonsense : {"", "device:", "device:-1", "device:1000000000000", "teapot"})
        EXPECT_THAT(refusalOf(nonsense), testing::HasSubstr(nonsense));
}

TEST(OffscreenContext, isNotLostAndWouldTell) {
    const auto context = makeOffscreenContext("auto", {16, 16});
    EXPECT_EQ(context->loss(), std::nullopt);
    GLint strategy = 0;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    EXPECT_EQ(strategy, GL_LOSE_CONTEXT_ON_RESET);
}

TEST(Driver, theFirstThingThatItLacksIsNamedWithBothNumbers) {
    const auto plenty = [](unsigned) { return 1 << 20; };
    EXPECT_EQ(lackOf(plenty), std::nullopt);
    EXPECT_EQ(lackOf([&](unsigned limit) {
                  return limit == GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS ? 0 : plenty(limit);
              }),
              "4 storage blocks in vertex shaders, it has 0");
}

TEST(OffscreenContext, movesBetweenThreads) {
    const auto context = makeOffscreenContext("auto", {16, 16});
    context->release();
    bool drawsThere = false;
    std::thread([&] {
        context->makeCurrent();
        drawsThere = glGetString(GL_RENDERER) != nullptr;
        context->release();
    }).join();
    EXPECT_TRUE(drawsThere);
}

// NOLINTBEGIN(concurrency-mt-unsafe): no other thread is running.
// Each in a process of its own: the loader reads its environment once.
[[noreturn]] void exitWithRefusal(const char* variable, const char* value) {
    setenv(variable, value, 1);
    const std::string refusal = refusalOf("auto");
    std::fprintf(stderr, "refused: %s\n", refusal.c_str());
    std::exit(refusal.empty() ? 0 : 1);
}
// NOLINTEND(concurrency-mt-unsafe)

TEST(OffscreenContextDeathTest, aMachineWithoutADriverIsToldWhatToInstall) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(exitWithRefusal("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere.json"),
                testing::ExitedWithCode(1),
                "refused: .*install");
}

TEST(OffscreenContextDeathTest, lessThanOpenGl45IsRefused) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(exitWithRefusal("MESA_GL_VERSION_OVERRIDE", "4.1"),
                testing::ExitedWithCode(1),
                "refused: .*4\\.5");
}

}  // namespace
}  // namespace aquarama::gl
