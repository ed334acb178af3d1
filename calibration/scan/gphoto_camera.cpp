// SPDX-License-Identifier: Apache-2.0
// A still camera, used by the program gphoto2. Its command line stays the same, while its library
// changes with every version of a camera's driver.
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
#include "common/base/characters.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::scan {

namespace {

namespace fs = std::filesystem;

// The output of a program and its exit status.
struct Said {
    int status = 0;
    std::string text;
};

// Reads a pipe until its other end is closed.
std::string readAll(int descriptor) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t count = 0; (count = read(descriptor, bytes.data(), bytes.size())) > 0;)
        if (text.size() < kMostBytes) text.append(bytes.data(), static_cast<std::size_t>(count));
    return text;
}

// The environment, with messages in English, which are parsed here.
std::vector<std::string> environmentInEnglish() {
    std::vector<std::string> all;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view variable(*entry);
        if (!variable.starts_with("LC_") && !variable.starts_with("LANG"))
            all.emplace_back(variable);
    }
    all.emplace_back("LC_ALL=C");
    return all;
}

// As exec takes them. They must outlive the result.
std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

// Without the signals that this program holds, so that Ctrl-C ends it as well.
pid_t startProgram(std::vector<std::string>& words, int output) {
    const std::vector<char*> pointers = pointersTo(words);
    std::vector<std::string> variables = environmentInEnglish();
    const std::vector<char*> environment = pointersTo(variables);
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
    if (posix_spawnp(
            &process, pointers[0], &actions, &attributes, pointers.data(), environment.data()) != 0)
        process = -1;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return process;
}

// Waits for its end. Throws Error where it cannot be started.
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

// The camera's names of exposures: lines "Choice: 12 1/60" of --get-config.
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
    void clear() const {
        for (const auto& entry : fs::directory_iterator(path())) fs::remove(entry.path());
    }
    // The first; empty where there is none.
    [[nodiscard]] std::string file() const {
        const fs::directory_iterator first(path());
        return first == fs::directory_iterator{} ? "" : first->path().string();
    }
    [[nodiscard]] const fs::path& path() const { return folder_.path(); }

  private:
    TemporaryFolder folder_{"camera"};
};

// Runs gphoto2 anew for each question, in a folder of its own.
class GphotoCamera final : public Camera {
  public:
    explicit GphotoCamera(const std::string& port) : port_{port} {
        const Said said = ask({"--get-config", "shutterspeed"});
        choices_ = choicesIn(said.text);
        const std::string cause = gphotoCause(said.text);
        if (said.status != 0)
            throw Error("gphoto2 cannot use the camera (" + cause + "); " + todoFor(cause));
        if (choices_.empty())
            throw Error("the camera lets no exposure be chosen (" +
                        (cause.empty() ? "it has no list of shutterspeed" : cause) +
                        "); set its dial to M, and see gphoto2 --get-config shutterspeed");
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
            throw Error("the camera has taken no picture (" + gphotoCause(said.text) +
                        "); see its display: focus it by hand, put in a card, charge it");
        return readPicture(file);
    }

  private:
    // What helps against what gphoto2 says, in its English.
    [[nodiscard]] static std::string todoFor(const std::string& cause) {
        constexpr const char* kEnd =
            "end other programs that use it, such as a desktop's own (gio mount -s gphoto2)";
        constexpr const char* kPermit =
            "let this user at it: the groups plugdev or camera, or a rule of udev";
        constexpr const char* kPlug =
            "plug it in, switch it on, and set its USB mode to PTP; gphoto2 --auto-detect lists "
            "cameras and ports";
        constexpr std::array<std::pair<const char*, const char*>, 7> kTodo{
            {{"claim", kEnd},
             {"busy", kEnd},
             {"ermission", kPermit},
             {"ccess", kPermit},
             {"detect", kPlug},
             {"No camera found", kPlug},
             {"find the requested device", kPlug}}};
        for (const auto& [said, todo] : kTodo)
            if (cause.find(said) != std::string::npos) return todo;
        return "plug it in, switch it on, and end other programs that use it";
    }
    // Throws Error where the program is not installed.
    [[nodiscard]] Said ask(const std::vector<std::string>& arguments) const {
        std::vector<std::string> words{"gphoto2"};
        if (!port_.empty()) words.insert(words.end(), {"--port", port_});
        words.insert(words.end(), arguments.begin(), arguments.end());
        return run(std::move(words));
    }
    // By ratio: stops of a camera are powers.
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

namespace {

// The lines of a text without blanks about them; empty ones are left out.
std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        const std::size_t first = text.find_first_not_of(" \t", at);
        const std::size_t last = text.find_last_not_of(" \t", end - (end > at ? 1 : 0));
        if (first < end && last != std::string::npos)
            lines.push_back(text.substr(first, last + 1 - first));
        at = end + 1;
    }
    return lines;
}

// The beginning of the lines that gphoto2 adds to every error.
bool isBoilerplate(const std::string& line) {
    constexpr std::array<const char*, 7> kBeginnings{"For debugging messages",
                                                     "Debugging messages may help",
                                                     "Please make sure",
                                                     "If you intend to use",
                                                     "When submitting",
                                                     "env LANG=C",
                                                     "gphoto2 --debug"};
    return std::ranges::any_of(kBeginnings,
                               [&](const char* beginning) { return line.starts_with(beginning); });
}

}  // namespace

std::string gphotoCause(const std::string& text) {
    constexpr std::size_t kMost = 200;
    constexpr const char* kHead = "*** Error ***";
    const std::vector<std::string> lines = linesOf(legible(text));
    // The last of the lines that pass; empty where none does.
    const auto lastWhere = [&](const auto& passes) {
        const auto found = std::find_if(lines.rbegin(), lines.rend(), passes);
        return found == lines.rend() ? std::string() : *found;
    };
    std::string cause = lastWhere(
        [&](const std::string& line) { return line.starts_with("*** Error") && line != kHead; });
    const auto head = std::ranges::find(lines, kHead);
    if (cause.empty() && std::distance(head, lines.end()) > 1) cause = *std::next(head);
    if (cause.empty())
        cause = lastWhere([](const std::string& line) { return !isBoilerplate(line); });
    return cause.substr(0, kMost);
}

std::unique_ptr<Camera> openGphoto(const std::string& port) {
    return std::make_unique<GphotoCamera>(port);
}

}  // namespace aquarama::scan
