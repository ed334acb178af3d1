// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift_command.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include "calibration/drift/dots.h"
#include "calibration/drift/drift.h"
#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "calibration/hall/true_hall.h"
#include "calibration/scan/capture.h"
#include "calibration/scan/pictures.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/config/rig.h"
#include "common/config/text_file.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct DriftOptions {
    std::string rig, camera, from, simulate, report, key;
    bool learns = false;
};

// "2026-11-24T21:03:01Z"
std::string timeNow() {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

// One look at the dots of a wall.
class DriftWatch {
  public:
    explicit DriftWatch(const DriftOptions& options)
        : options_(options), rig_(config::readRigAsHung(options.rig)) {}

    int run() {
        openPictures();
        return options_.learns ? learn() : watch();
    }

  private:
    // Beside the calibration, or the rig where that names none.
    [[nodiscard]] fs::path beside(const char* ending) const {
        const std::string calibration =
            config::parseRig(config::readTextFile(options_.rig), options_.rig).calibration;
        const fs::path file =
            calibration.empty() ? options_.rig : config::besideFile(options_.rig, calibration);
        return fs::path(file).replace_extension(ending);
    }

    void openPictures() {
        const auto sequence = scan::dotSequenceOf(rig_, options_.learns);
        if (!options_.simulate.empty()) {
            truth_ = std::make_unique<hall::TrueHall>(
                rig_, hall::hallFrom("--simulate", options_.simulate, rig_));
            source_ = std::make_unique<hall::SimulatedCamera>(*truth_, sequence);
            return;
        }
        const std::string folder = options_.from.empty() ? beside(".dots").string() : options_.from;
        if (options_.from.empty())
            scan::captureShow(rig_,
                              {.rig = options_.rig, .master = {}, .key = options_.key},
                              options_.camera,
                              sequence,
                              folder);
        source_ = scan::openFolder(folder, rig_);
    }

    int learn() {
        const drift::Reference reference{.learned = timeNow(),
                                         .cameraPixels = source_->picture(0).sizePixels,
                                         .dots = drift::numberedDots(*source_, rig_)};
        const drift::WallDrift self = drift::driftOf(reference, reference.dots, rig_);
        for (std::size_t i = 0; i < rig_.channels.size(); ++i)
            if (self.channels[i].verdict == drift::DriftVerdict::NotSeen)
                throw Error(
                    fmt::format("channel \"{}\" has too few dots that the camera sees; show "
                                "all of its picture to the camera, and learn again",
                                rig_.channels[i].name));
        const std::string text = drift::textOf(reference, rig_);
        writeWhole(beside(".drift.json"), std::as_bytes(std::span(text)));
        cli::say(fmt::format("{}: {} dots of {} channels; leave the camera where it is",
                             beside(".drift.json").string(),
                             reference.dots.size(),
                             rig_.channels.size()));
        return 0;
    }

    int watch() {
        const fs::path path = beside(".drift.json");
        if (!fs::exists(path))
            throw Error(path.string() +
                        ": is not there; run aquarama drift --learn right after a calibration");
        const drift::Reference reference =
            drift::parseReference(config::readTextFile(path.string()), path.string(), rig_);
        if (source_->picture(0).sizePixels != reference.cameraPixels)
            throw Error(
                "the camera's pictures have another size than those that were learned; "
                "set it as it was, or calibrate and learn again");
        const drift::WallDrift drift =
            drift::driftOf(reference, drift::foundAgain(*source_, reference.dots), rig_);
        report(drift, reference);
        return statusOf(drift);
    }

    void report(const drift::WallDrift& drift, const drift::Reference& reference) const {
        const std::string text = drift::jsonOf(drift, timeNow(), reference, rig_);
        const auto bytes = std::as_bytes(std::span(text));
        if (!options_.report.empty()) writeWhole(fs::path(options_.report) / "drift.json", bytes);
        writeWhole(beside(".drift.last.json"), bytes);  // for the operator's console
        cli::say(fmt::format("since {}; the camera moved by {:.2f} of its pixels",
                             reference.learned,
                             drift.cameraPixels));
        if (drift.isCameraLost)
            cli::say("the camera has moved too far: put it back, or calibrate and learn again");
        else
            for (std::size_t i = 0; i < drift.channels.size(); ++i)
                cli::say(drift::lineOf(rig_.channels[i], drift.channels[i]));
    }

    [[nodiscard]] static int statusOf(const drift::WallDrift& drift) {
        int status = drift.isCameraLost ? 2 : 0;
        for (const drift::ChannelDrift& channel : drift.channels) {
            if (channel.verdict == drift::DriftVerdict::NotSeen) return 2;
            if (channel.verdict == drift::DriftVerdict::Moved) status = std::max(status, 1);
        }
        return status;
    }

    const DriftOptions& options_;
    config::Rig rig_;
    std::unique_ptr<hall::TrueHall> truth_;
    std::unique_ptr<scan::PictureSource> source_;
};

int look(const DriftOptions& options) {
    constexpr int kCannotTell = 2;
    try {
        cli::requireFolder("--report", options.report);
        return DriftWatch(options).run();
    } catch (const Error& error) {
        cli::sayError("aquarama drift", error.what());
        return kCannotTell;
    }
}

}  // namespace

void addDrift(cli::CommandLine& line) {
    const auto [command, options] = line.add<DriftOptions>(
        "drift", "Says whether a projector has moved since its dots were learned.", look);
    command.add_option("--rig", options.rig, "the rig")->required();
    auto& source = *command.add_option_group("pictures", "where the pictures come from");
    source.add_option(
        "--camera", options.camera, "as for aquarama calibrate; the show must be running");
    source.add_option("--from", options.from, "a folder of pictures that were taken before");
    source.add_option("--simulate", options.simulate, "a simulated hall: a file or random:SEED");
    source.require_option(1);
    command.add_flag(
        "--learn", options.learns, "keep where the dots are, right after a calibration");
    command.add_option("--report", options.report, "folder for drift.json, the figures");
    command.add_option("--key", options.key, "key of the crew, where the rig needs one");
    command.footer("Exit status: 0 all in place, 1 a projector has moved, 2 it cannot be told.");
}

}  // namespace aquarama
