// SPDX-License-Identifier: Apache-2.0
#include <google/protobuf/text_format.h>

#include "common/config/angle.h"
#include "common/config/rig.h"
#include "common/config/rig.pb.h"

namespace aquarama::config {

namespace {

std::uint32_t unsignedOf(int value) {
    return static_cast<std::uint32_t>(value);
}

void write(const Screen& screen, v1::Screen& out) {
    out.set_radius_m(screen.radiusMetres);
    out.set_arc_deg(degreesOf(screen.arcRadians));
    out.set_height_m(screen.heightMetres);
}

void write(const Timing& timing, v1::Timing& out) {
    out.set_refresh_hz(timing.refreshHertz);
    out.set_present_deadline_s(timing.presentDeadlineSeconds);
    out.set_membership_s(timing.membershipSeconds);
}

void write(const glm::dvec3& position, v1::Position& out) {
    out.set_x_m(position.x);
    out.set_y_m(position.y);
    out.set_z_m(position.z);
}

v1::Stereo::Mode modeOf(StereoMode mode) {
    return static_cast<v1::Stereo::Mode>(static_cast<int>(mode) + 1);
}

void write(const Stereo& stereo, v1::Stereo& out) {
    out.set_mode(modeOf(stereo.mode));
    out.set_eye_separation_m(stereo.eyeSeparationMetres);
    out.set_swap_eyes(stereo.swapEyes);
}

void write(const Projector& projector, v1::Projector& out) {
    write(projector.positionMetres, *out.mutable_position());
    out.set_yaw_deg(degreesOf(projector.yawPitchRollRadians.x));
    out.set_pitch_deg(degreesOf(projector.yawPitchRollRadians.y));
    out.set_roll_deg(degreesOf(projector.yawPitchRollRadians.z));
    out.set_focal_x_px(projector.focalPixels.x);
    out.set_focal_y_px(projector.focalPixels.y);
    out.set_principal_x_px(projector.principalPixels.x);
    out.set_principal_y_px(projector.principalPixels.y);
}

void write(const Display& display, v1::Display& out) {
    out.set_mode(display.mode == DisplayMode::Window ? v1::Display::WINDOW
                                                     : v1::Display::FULLSCREEN);
    out.set_monitor(unsignedOf(display.monitor));
    out.set_window_x_px(display.windowPosition.x);
    out.set_window_y_px(display.windowPosition.y);
    out.set_device(display.device);
    if (display.refreshHertz) out.set_refresh_hz(*display.refreshHertz);
    if (display.stereo) out.set_stereo(modeOf(*display.stereo));
    if (display.swapEyes) out.set_swap_eyes(*display.swapEyes);
}

void write(const Channel& channel, v1::Channel& out) {
    out.set_id(channel.id);
    out.set_name(channel.name);
    out.set_width_px(unsignedOf(channel.sizePixels.x));
    out.set_height_px(unsignedOf(channel.sizePixels.y));
    write(channel.projector, *out.mutable_projector());
    write(channel.display, *out.mutable_display());
}

}  // namespace

std::string writeRig(const Rig& rig) {
    v1::Rig out;
    out.set_name(rig.name);
    write(rig.screen, *out.mutable_screen());
    out.mutable_panorama()->set_width_px(unsignedOf(rig.panoramaPixels.x));
    out.mutable_panorama()->set_height_px(unsignedOf(rig.panoramaPixels.y));
    out.mutable_network()->set_control(rig.controlAddress);
    out.mutable_network()->set_state(rig.stateAddress);
    write(rig.timing, *out.mutable_timing());
    out.set_scene(rig.scene);
    write(rig.stereo, *out.mutable_stereo());
    write(rig.sweetSpotMetres, *out.mutable_sweet_spot());
    if (rig.quality)
        out.set_quality(
            static_cast<v1::Rig::Quality>(v1::Rig::LOW + static_cast<int>(*rig.quality)));
    for (const Channel& channel : rig.channels) write(channel, *out.add_channels());
    std::string text;
    google::protobuf::TextFormat::PrintToString(out, &text);
    return text;
}

}  // namespace aquarama::config
