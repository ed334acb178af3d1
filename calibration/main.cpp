// SPDX-License-Identifier: Apache-2.0
// aquarama-calibrate: from pictures of a wall that a camera took, or a simulated one takes, to the
// wall file that render nodes take.
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "calibration/drift_command.h"
#include "calibration/geometry/solve.h"
#include "calibration/hall/drawn_wall.h"
#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "calibration/hall/true_hall.h"
#include "calibration/result/figures.h"
#include "calibration/result/page.h"
#include "calibration/result/wall_of.h"
#include "calibration/scan/capture.h"
#include "calibration/scan/decode.h"
#include "calibration/scan/pictures.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/versions.h"
#include "common/cli/commands.h"
#include "common/cli/outputs.h"
#include "common/config/rig.h"
#include "common/formats/mpcdi.h"
#include "common/wall/wall.h"

namespace aquarama {
namespace {

struct Options {
    std::string rig, camera, from, simulate, out, report, keep, key;
};

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

double peakMegabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

// One calibration, from the pictures to the files.
class Calibration {
  public:
    explicit Calibration(const Options& options)
        : options_(options), rig_(config::readRigAsHung(options.rig)), wall_(rig_) {}

    int run() {
        openPictures();
        if (options_.camera.empty() && !options_.keep.empty()) {
            scan::writeFolder(*source_, options_.keep, rig_);
            source_ = scan::openFolder(options_.keep, rig_);
        }
        const auto begin = Clock::now();
        const std::vector<scan::CameraView> views = decoded();
        const geometry::Solved solved = geometry::solveHall(rig_, wall_, views, cli::say);
        result::Figures figures{.verdict = result::judged(views, solved), .solve = solved.figures};
        const bool isRefused = figures.verdict.judgement == result::Judgement::Refuse;
        if (!isRefused) write(solved, views.front(), figures);
        figures.seconds = secondsSince(begin);
        figures.pictures = source_->scan().pictures.size();
        figures.peakMegabytes = peakMegabytes();
        report(figures);
        if (!isRefused) keepVersion(options_.out, result::jsonOf(figures));
        writePage({.figures = figures,
                   .solved = solved,
                   .views = views,
                   .truth = truth_.get(),
                   .wallFile = options_.out});
        return isRefused ? 1 : 0;
    }

  private:
    // Beside the wall file where no other folder is named: a scan of an hour ago may be worth much.
    [[nodiscard]] std::string keptIn() const {
        if (!options_.keep.empty()) return options_.keep;
        return std::filesystem::path(options_.out).replace_extension(".scan").string();
    }

    [[nodiscard]] std::vector<scan::CameraView> decoded() {
        std::vector<scan::CameraView> views;
        for (std::uint32_t i = 0; i < source_->scan().cameras.size(); ++i) {
            cli::say(fmt::format("reading {} pictures", source_->scan().pictures.size()));
            views.push_back(scan::decode(*source_, i, rig_));
        }
        return views;
    }

    void openPictures() {
        if (!options_.camera.empty()) {
            scan::captureShow(rig_,
                              {.rig = options_.rig, .master = {}, .key = options_.key},
                              options_.camera,
                              scan::sequenceOf(rig_),
                              keptIn());
            source_ = scan::openFolder(keptIn(), rig_);
            return;
        }
        if (!options_.from.empty()) {
            source_ = scan::openFolder(options_.from, rig_);
            return;
        }
        const config::Hall hall = hall::hallFrom("--simulate", options_.simulate, rig_);
        truth_ = std::make_unique<hall::TrueHall>(rig_, hall);
        source_ = std::make_unique<hall::SimulatedCamera>(*truth_, scan::sequenceOf(rig_));
    }

    void write(const geometry::Solved& solved,
               const scan::CameraView& view,
               result::Figures& figures) {
        cli::say("evening light and colour");
        const result::ShadedWall wall = result::shadedWallOf(*solved.hall, view);
        figures.verdict = result::judgedLight(figures.verdict, wall.brightness, wall.seams);
        figures.brightness = wall.brightness;
        figures.foreseen = wall.seams;
        cli::say("writing the wall file");
        keepVersion(options_.out, "");  // what is there before
        writeWhole(options_.out, formats::encodeMpcdi(wall.file, 2));
        constexpr std::size_t kPoints = 20000;
        if (!truth_) return;
        if (!std::filesystem::is_regular_file(options_.out)) return;  // a pipe is not read again
        figures.truth = result::trueFigures(
            result::errorsOf(*truth_, rig_, wall.file, kPoints),
            light::seamsOf(*truth_, hall::DrawnWall(hall::withWallFile(rig_, options_.out))));
    }

    void report(const result::Figures& figures) const {
        if (!options_.report.empty()) {
            const std::string text = result::jsonOf(figures);
            writeWhole(std::filesystem::path(options_.report) / "figures.json",
                       std::as_bytes(std::span(text)));
        }
        const result::CalibrationVerdict& verdict = figures.verdict;
        cli::say(fmt::format("{}{}{}",
                             result::nameOf(verdict.judgement),
                             verdict.cause.empty() ? "" : ": " + verdict.cause + ": ",
                             verdict.advice));
        if (verdict.judgement == result::Judgement::Refuse) return;
        const geometry::OverlapFigures& overlap = figures.overlap();
        cli::say(overlap.points == 0
                     ? "no two channels overlap: there is no overlap to measure"
                     : fmt::format("neighbours part by {:.2f} panorama pixels (RMS; 95 % {:.2f}, "
                                   "most {:.2f})",
                                   overlap.rms,
                                   overlap.p95,
                                   overlap.most));
        if (figures.truth)
            cli::say(fmt::format("the picture is {:.2f} panorama pixels off (RMS)",
                                 figures.truth->absoluteRms));
        cli::say(options_.out);
    }

    void writePage(const result::CalibrationPage& content) const {
        if (options_.report.empty()) return;
        const std::string text = result::htmlOf(content);
        const std::filesystem::path path = std::filesystem::path(options_.report) / "index.html";
        writeWhole(path, std::as_bytes(std::span(text)));
        cli::say(path.string());
    }

    const Options& options_;
    config::Rig rig_;
    wall::Wall wall_;
    std::unique_ptr<hall::TrueHall> truth_;
    std::unique_ptr<scan::PictureSource> source_;
};

int calibrate(const Options& options) {
    cli::requireFile("--out", options.out);
    cli::requireFolder("--report", options.report);
    return Calibration(options).run();
}

void describe(CLI::App& app, Options& options) {
    app.add_option("--rig", options.rig, "the rig, with its projectors about where they hang")
        ->required();
    auto& source = *app.add_option_group("pictures", "where the pictures come from");
    source.add_option("--camera",
                      options.camera,
                      "/dev/video0, gphoto2: or whatever FFmpeg reads; the show must be running");
    source.add_option("--from", options.from, "a folder of pictures that were taken before");
    source.add_option("--simulate",
                      options.simulate,
                      "a simulated hall: a file that tells what is wrong in it, or random:SEED");
    source.require_option(1);
    app.add_option("--out", options.out, "the wall file to write (.mpcdi)")->required();
    app.add_option("--report", options.report, "folder for a page with pictures and figures");
    app.add_option("--keep", options.keep, "folder for the pictures, to solve them again");
    app.add_option("--key", options.key, "key of the crew, where the rig needs one");
}

// A command of aquarama-compose, which had the name of this program until version 0.2.
struct FormerCommand {
    const CLI::App* command = nullptr;
};

// Does not return: aquarama-compose takes the place of this process.
void becomeCompose(const FormerCommand& former) {
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "aquarama-compose";
    std::vector<std::string> words = former.command->remaining();
    const std::string name = former.command->get_name();
    words.insert(words.begin(), {"aquarama-compose", name == "theatre" ? "view" : name});
    cli::sayError("aquarama-calibrate",
                  words[1] +
                      " is a command of aquarama-compose now; this way to it ends with the next "
                      "release");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    throw Error("cannot start " + program.string() + "; install it beside this program");
}

void addFormerCommands(cli::CommandLine& line) {
    for (const char* name : {"check", "compose", "clip", "theatre", "inspect"}) {
        const auto [command, options] = line.add<FormerCommand>(name, "", becomeCompose);
        command.prefix_command();
        command.set_help_flag();  // the other program has its own
        options.command = &command;
        line.hide(name);
    }
}

}  // namespace
}  // namespace aquarama

// NOLINTNEXTLINE(bugprone-exception-escape): outside runProgram() only a lack of memory throws
int main(int count, char** arguments) {
    using namespace aquarama;
    CLI::App app("Finds how projectors hang before their screen, from pictures of patterns.",
                 "aquarama calibrate");
    cli::CommandLine line(app);
    addDrift(line);
    addFormerCommands(line);
    Options options;
    describe(app, options);
    // A command needs none of the options of the calibration itself.
    for (CLI::App* command : app.get_subcommands({}))
        command->preparse_callback([&app](std::size_t) {
            for (CLI::Option* option : app.get_options()) option->required(false);
            app.get_option_group("pictures")->require_option(0);
        });
    return cli::runProgram(app, count, arguments, [&] {
        return line.isChosen() ? line.runChosen() : calibrate(options);
    });
}
