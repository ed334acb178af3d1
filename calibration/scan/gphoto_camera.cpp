// SPDX-License-Identifier: Apache-2.0
// A still camera through the program gphoto2: its library changes with every version of a camera's
// driver, its command line does not.
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "calibration/scan/camera_controls.h"
#include "calibration/scan/read_picture.h"
#include "common/base/log.h"

namespace aquarama::scan {

namespace {

namespace fs = std::filesystem;

// What a program has said, and how it ended.
struct Said {
    int status = 0;
    std::string text;
};

// All that comes through a pipe until its other end is closed.
std::string readAll(int descriptor) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t count = 0; (count = read(descriptor, bytes.data(), bytes.size())) > 0;)
        if (text.size() < kMostBytes) text.append(bytes.data(), static_cast<std::size_t>(count));
    return text;
}

// Without the signals that this program holds, so that Ctrl-C ends it as well.
pid_t startProgram(std::vector<std::string>& words, int output) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    pid_t process = -1;
    if (posix_spawnp(&process, pointers[0], &actions, &attributes, pointers.data(), environ) != 0)
        process = -1;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return process;
}

Said run(std::vector<std::string> words) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("no pipe is left for gphoto2");
    const pid_t process = startProgram(words, ends[1]);
    close(ends[1]);
    Said said;
    said.text = process < 0 ? "" : readAll(ends[0]);
    close(ends[0]);
    if (process < 0)
        throw Error("gphoto2 is not installed; install the package gphoto2, or use another camera");
    waitpid(process, &said.status, 0);
    return said;
}

// "1/60", "0.5" or "2", with or without an "s"; 0 for bulb and the like.
double secondsIn(const std::string& text) {
    char* end = nullptr;
    const double first = std::strtod(text.c_str(), &end);
    if (end == text.c_str()) return 0;
    if (*end != '/') return first;
    const double second = std::strtod(end + 1, nullptr);
    return second > 0 ? first / second : 0;
}

// By exposure, what the camera calls it: lines "Choice: 12 1/60" of --get-config.
std::map<double, std::string> choicesIn(const std::string& text) {
    constexpr std::string_view kChoice = "Choice: ";
    std::map<double, std::string> choices;
    for (std::size_t at = text.find(kChoice); at != std::string::npos;
         at = text.find(kChoice, at + 1)) {
        const std::size_t name = text.find(' ', at + kChoice.size());
        const std::size_t end = text.find('\n', at);
        if (name == std::string::npos || name > end) continue;
        const std::string value = text.substr(name + 1, end - name - 1);
        if (const double seconds = secondsIn(value); seconds > 0) choices.emplace(seconds, value);
    }
    return choices;
}

// A folder for one picture at a time, which goes with the camera.
class PictureFolder {
  public:
    PictureFolder() {
        std::string name = (fs::temp_directory_path() / "aquarama-camera-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw Error(name + ": cannot be made");
        path_ = name;
    }
    ~PictureFolder() {
        std::error_code none;
        fs::remove_all(path_, none);
    }
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;

    void clear() const {
        for (const auto& entry : fs::directory_iterator(path_)) fs::remove(entry.path());
    }
    // The first; empty where there is none.
    [[nodiscard]] std::string file() const {
        const fs::directory_iterator first(path_);
        return first == fs::directory_iterator{} ? "" : first->path().string();
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

class GphotoCamera final : public Camera {
  public:
    explicit GphotoCamera(const std::string& port) : port_{port} {
        const Said said = ask({"--get-config", "shutterspeed"});
        choices_ = choicesIn(said.text);
        if (said.status != 0)
            throw Error("gphoto2 finds no camera (" + lastLineOf(said.text) +
                        "); plug it in, switch it on, and end other programs that use it");
        if (choices_.empty())
            throw Error("the camera lets no exposure be chosen; set its dial to M");
    }

    [[nodiscard]] ExposureRange exposures() const override {
        return {choices_.begin()->first, choices_.rbegin()->first};
    }

    [[nodiscard]] Picture take(double exposureSeconds) override {
        folder_.clear();
        const Said said = ask({"--set-config-value",
                               "shutterspeed=" + nearest(exposureSeconds),
                               "--capture-image-and-download",
                               "--force-overwrite",
                               "--filename",
                               (folder_.path() / "picture.%C").string()});
        const std::string file = folder_.file();
        if (said.status != 0 || file.empty())
            throw Error("the camera has taken no picture (" + lastLineOf(said.text) +
                        "); see its display");
        return readPicture(file);
    }

  private:
    [[nodiscard]] static std::string lastLineOf(std::string text) {
        while (text.ends_with('\n')) text.pop_back();
        return text.substr(text.rfind('\n') + 1);
    }
    [[nodiscard]] Said ask(const std::vector<std::string>& arguments) const {
        std::vector<std::string> words{"gphoto2"};
        if (!port_.empty()) words.insert(words.end(), {"--port", port_});
        words.insert(words.end(), arguments.begin(), arguments.end());
        return run(std::move(words));
    }
    [[nodiscard]] const std::string& nearest(double seconds) const {
        const auto distance = [seconds](const auto& choice) {
            return std::abs(std::log(choice.first / seconds));
        };
        return std::ranges::min_element(choices_, {}, distance)->second;
    }

    std::string port_;
    std::map<double, std::string> choices_;
    PictureFolder folder_;
};

}  // namespace

std::unique_ptr<Camera> openGphoto(const std::string& port) {
    return std::make_unique<GphotoCamera>(port);
}

}  // namespace aquarama::scan
