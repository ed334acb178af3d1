// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/run_node.h"

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include <pthread.h>

#include "common/cli/command_line.h"
#include "common/machine/service_notifier.h"
#include "common/wall/wall.h"
#include "render_node/gl/context.h"
#include "render_node/session/session.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/channel_show.h"
#include "render_node/show/controls.h"

namespace aquarama::show {

namespace {

using namespace std::chrono_literals;

// How long the main thread waits for events at a time, hence how late it may notice that the
// drawing thread has ended.
constexpr auto kPatience = 20ms;

// The channel's window, or a context without one. It is current on no thread afterwards.
std::unique_ptr<gl::Context> openContext(const NodeOptions& options,
                                         const config::Rig& rig,
                                         std::size_t index) {
    const config::Channel& channel = rig.channels[index];
    config::Display display = channel.display;
    if (!options.connector.empty()) display.connector = options.connector;
    if (!options.headless)
        return gl::makeWindowContext(
            display,
            "Aquarama " + channel.name,
            channel.sizePixels,
            wall::stereoOf(rig, index).mode == config::StereoMode::QuadBuffer);
    const std::string& device = options.device.empty() ? display.device : options.device;
    auto context = gl::makeOffscreenContext(device, channel.sizePixels);
    context->release();
    return context;
}

// Body of the drawing thread. Its errors reach the main thread through the future.
void show(session::Session& session,
          gl::Context& context,
          Controls& controls,
          machine::ServiceNotifier& service,
          const NodeOptions& options,
          session::Admission admission) {
    pthread_setname_np(pthread_self(), "frames");  // for debuggers, and tests that hold it
    ChannelShow(session, context, controls, service, options).run(std::move(admission));
}

}  // namespace

bool runNode(const NodeOptions& options) {
    // Before any thread starts, so that all of them inherit the blocked signals.
    cli::holdSignals();
    const std::unique_ptr<session::Session> session =
        session::connectSession(options.channel, options.masterAddresses, options.keys);
    machine::ServiceNotifier service;
    const cli::SignalWatch watch([&] {
        service.stopping();
        session->stop();
    });
    session->whileWaiting([&] { service.alive(0); });
    service.status("waiting for the master at " + options.masterAddresses.front());
    std::optional<session::Admission> admission = session->join();
    if (!admission) return session->isToRestart();
    const std::size_t channel = channelIndex(admission->rig, options.channel);
    const std::unique_ptr<gl::Context> context = openContext(options, admission->rig, channel);
    Controls controls(*session, admission->rig.windowsEndShow);
    NodeOptions described = options;
    described.monitors = context->monitors();
    std::future<void> drawing = std::async(std::launch::async, [&] {
        show(*session, *context, controls, service, described, std::move(*admission));
    });
    while (drawing.wait_for(0s) != std::future_status::ready) {
        context->pumpEvents(kPatience);
        while (const std::optional<char> key = context->nextKey()) controls.press(*key);
        while (const auto place = context->nextClick()) controls.click(*place);
        controls.point(context->pointer(), net::monotonicNow());
        controls.hold(context->hands(), net::monotonicNow());
    }
    drawing.get();
    return session->isToRestart();
}

}  // namespace aquarama::show
