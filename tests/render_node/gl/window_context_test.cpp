// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "render_node/gl/context.h"
#include "tests/render_node/gl/virtual_display.h"
#include "tests/render_node/gl/wayland_display.h"

namespace aquarama::gl {
namespace {

using namespace std::chrono_literals;

config::Display windowAt(glm::ivec2 position) {
    config::Display display;
    display.windowPosition = position;
    return display;
}

std::string refusalOf(const config::Display& display, glm::ivec2 size) {
    try {
        (void)makeWindowContext(display, "Aquarama refused", size);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

void fillWith(Context& context, float red, float green, float blue) {
    context.makeCurrent();
    glClearColor(red, green, blue, 1);
    for (int frame = 0; frame < 3; ++frame) {
        glClear(GL_COLOR_BUFFER_BIT);
        context.swap();
    }
    glFinish();
    context.release();
}

class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        if (!display_)
            GTEST_SKIP() << "Xvfb, xdotool and xwd (x11-apps) are needed to test windows";
    }
    std::unique_ptr<VirtualDisplay> display_ = VirtualDisplay::start();
};

TEST_F(WindowTest, isInItsPlaceToThePixelAndShowsWhatIsDrawn) {
    const glm::ivec2 place(120, 60);
    const glm::ivec2 size(320, 200);
    const auto context = makeWindowContext(windowAt(place), "Aquarama test", size);
    EXPECT_EQ(context->framebufferPixels(), size);
    EXPECT_TRUE(context->hasWindow());
    // Drawn on another thread than the one that handles events, as nodes do.
    std::thread([&] { fillWith(*context, 1, 0.4F, 0); }).join();
    context->pumpEvents(10ms);
    const std::vector<std::uint8_t> shown = VirtualDisplay::screenshot();
    for (int y = 0; y < VirtualDisplay::kSize.y; ++y)
        for (int x = 0; x < VirtualDisplay::kSize.x; ++x) {
            const glm::ivec2 inside = glm::ivec2(x, y) - place;
            const bool isWindow =
                inside.x >= 0 && inside.y >= 0 && inside.x < size.x && inside.y < size.y;
            const auto red = static_cast<std::size_t>(y * VirtualDisplay::kSize.x + x) * 3;
            const std::vector<int> colour{shown[red], shown[red + 1], shown[red + 2]};
            ASSERT_EQ(colour, isWindow ? (std::vector{255, 102, 0}) : (std::vector{0, 0, 0}))
                << "at " << x << ", " << y;
        }
}

TEST_F(WindowTest, deliversKeysInOrder) {
    const auto context = makeWindowContext(windowAt({0, 0}), "Aquarama keys", {200, 100});
    const std::string wanted = std::string("wbih ") + kEscapeKey;
    std::thread hand([] {
        for (const char* key : {"w", "b", "F7", "i", "h", "space", "Escape"})
            VirtualDisplay::press("Aquarama keys", key);
    });
    std::string pressed;
    for (int wait = 0; wait < 1000 && pressed.size() < wanted.size(); ++wait) {
        context->pumpEvents(10ms);
        while (const auto key = context->nextKey()) pressed += *key;
    }
    hand.join();
    EXPECT_EQ(pressed, wanted);
}

TEST_F(WindowTest, saysWhereTheMouseClicksAndPoints) {
    const glm::ivec2 place(120, 60);
    const auto context = makeWindowContext(windowAt(place), "Aquarama mouse", {320, 200});
    std::thread hand([&] {
        VirtualDisplay::point(place + glm::ivec2(30, 40), "1");
        VirtualDisplay::point(place + glm::ivec2(50, 60), "3");  // the other button is not ours
        VirtualDisplay::point(place - glm::ivec2(10, 10), "1");  // beside the window
        VirtualDisplay::point(place + glm::ivec2(319, 199), "1");
    });
    std::vector<glm::vec2> clicks;
    for (int wait = 0; wait < 1000 && clicks.size() < 2; ++wait) {
        context->pumpEvents(10ms);
        while (const auto click = context->nextClick()) clicks.push_back(*click);
    }
    hand.join();
    EXPECT_EQ(clicks, (std::vector<glm::vec2>{{30, 40}, {319, 199}}));
    EXPECT_EQ(context->pointer(), glm::vec2(319, 199));
    VirtualDisplay::point(place - glm::ivec2(10, 10));
    for (int wait = 0; wait < 500 && context->pointer(); ++wait) context->pumpEvents(10ms);
    EXPECT_FALSE(context->pointer());
}

// No software driver has two back buffers.
TEST_F(WindowTest, withoutQuadBuffersItSaysWhatElseThereIs) {
    try {
        (void)makeWindowContext(windowAt({0, 0}), "Aquarama quad", {200, 100}, true);
        FAIL() << "a window with left and right buffers came of nothing";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    testing::AllOf(testing::HasSubstr("no window with left and right buffers"),
                                   testing::HasSubstr("choose another stereo mode in the rig")));
    }
}

TEST_F(WindowTest, keysAndADraggedMouseAreHeldUntilTheyAreLetGo) {
    const auto context = makeWindowContext(windowAt({100, 100}), "Aquarama hands", {200, 100});
    const auto awaitThat = [&](const auto& holds) {
        for (int wait = 0; wait < 500 && !holds(context->hands()); ++wait)
            context->pumpEvents(10ms);
        return holds(context->hands());
    };
    VirtualDisplay::hold("Aquarama hands", "keydown w keydown Prior");
    EXPECT_TRUE(awaitThat([](const Hands& hands) {
        return hands.keys.count() == 2 && hands.holds(HeldKey::W) && hands.holds(HeldKey::PageUp);
    }));
    VirtualDisplay::hold("Aquarama hands", "keyup w keyup Prior");
    EXPECT_TRUE(awaitThat([](const Hands& hands) { return hands.keys.none(); }));
    VirtualDisplay::hold("Aquarama hands", "mousemove --sync 150 150 mousedown 3");
    EXPECT_TRUE(awaitThat([](const Hands& hands) { return hands.drag == glm::vec2(0); }));
    VirtualDisplay::hold("Aquarama hands", "mousemove --sync 200 125");
    EXPECT_TRUE(awaitThat([](const Hands& hands) {
        return hands.drag && glm::distance(*hands.drag, glm::vec2(0.5F, 0.25F)) < 0.02F;
    }));
    EXPECT_FALSE(context->nextClick()) << "only the left button feeds";
    VirtualDisplay::hold("Aquarama hands", "mouseup 3");
    EXPECT_TRUE(awaitThat([](const Hands& hands) { return !hands.drag; }));
    EXPECT_EQ(context->hands().pad.leftStick, glm::vec2(0)) << "no gamepad here";
}

TEST_F(WindowTest, goesFullscreenAndBack) {
    const auto context = makeWindowContext(windowAt({50, 50}), "Aquarama full", {200, 100});
    const auto pressUntil = [&](glm::ivec2 size) {
        VirtualDisplay::press("Aquarama full", "f");
        for (int wait = 0; wait < 500 && context->framebufferPixels() != size; ++wait)
            context->pumpEvents(10ms);
        return context->framebufferPixels();
    };
    EXPECT_EQ(pressUntil(VirtualDisplay::kSize), VirtualDisplay::kSize);
    EXPECT_EQ(pressUntil({200, 100}), glm::ivec2(200, 100));
}

TEST_F(WindowTest, fullscreenTakesTheMonitorOfItsSize) {
    config::Display display;
    display.mode = config::DisplayMode::Fullscreen;
    const auto context = makeWindowContext(display, "Aquarama wall", VirtualDisplay::kSize);
    EXPECT_EQ(context->framebufferPixels(), VirtualDisplay::kSize);
}

TEST_F(WindowTest, aMonitorThatIsNotTheChannelsIsRefused) {
    config::Display display;
    display.mode = config::DisplayMode::Fullscreen;
    EXPECT_THAT(refusalOf(display, {1400, 1050}),
                testing::HasSubstr("cannot show the channel's 1400 x 1050"));
    display.connector = "HDMI-9";
    EXPECT_THAT(refusalOf(display, VirtualDisplay::kSize),
                testing::HasSubstr("no monitor HDMI-9; this machine has screen"));
    display.connector.clear();
    display.refreshHertz = 119.88;
    EXPECT_THAT(refusalOf(display, VirtualDisplay::kSize), testing::HasSubstr("120 Hz"));
    display.mode = config::DisplayMode::Window;
    EXPECT_THAT(refusalOf(display, {200, 100}), testing::HasSubstr("refresh rate"));
}

// NOLINTBEGIN(concurrency-mt-unsafe): no other thread is running.
TEST(WindowContext, withoutADisplayAsksForHeadless) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    EXPECT_THAT(refusalOf(windowAt({0, 0}), {200, 100}), testing::HasSubstr("--headless"));
    setenv("DISPLAY", ":4711", 1);
    EXPECT_THAT(refusalOf(windowAt({0, 0}), {200, 100}), testing::HasSubstr("--headless"));
    unsetenv("DISPLAY");
}
// NOLINTEND(concurrency-mt-unsafe)

TEST(WindowContext, opensOnWaylandWhereThereIsNoX) {
    const auto display = WaylandDisplay::start();
    if (!display) GTEST_SKIP() << "weston, Xvfb and GLFW 3.4 are needed to test windows on Wayland";
    const glm::ivec2 size(320, 200);
    const auto window = makeWindowContext(windowAt({0, 0}), "Aquarama on Wayland", size);
    fillWith(*window, 0, 0.5F, 1);
    window->pumpEvents(1ms);
    EXPECT_EQ(window->framebufferPixels(), size);
    EXPECT_THAT(window->description(), testing::HasSubstr("Wayland"));
}

}  // namespace
}  // namespace aquarama::gl
