// SPDX-License-Identifier: Apache-2.0
#include "console/files_of_show.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <span>

#include <nlohmann/json.hpp>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/base/versions.h"
#include "common/config/rig.h"
#include "common/config/text_file.h"
#include "common/formats/archive.h"
#include "console/json_fields.h"
#include "console/run_aquarama.h"

namespace aquarama::console {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Of the list in memory; the file is only added to.
constexpr std::size_t kMostEvents = 200;

// The last `most` bytes of a file, from the beginning of a line; empty where it cannot be read.
std::string endOf(const fs::path& path, std::uintmax_t most) {
    std::error_code failure;
    const std::uintmax_t size = fs::file_size(path, failure);
    std::ifstream file(path, std::ios::binary);
    if (failure || !file) return {};
    const std::uintmax_t begin = size > most ? size - most : 0;
    file.seekg(static_cast<std::streamoff>(begin));
    std::string text(static_cast<std::size_t>(size - begin), '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return begin == 0 ? text : text.substr(std::min(text.find('\n'), text.size() - 1) + 1);
}

// A whole file of JSON; null where there is none, or it is something else.
json jsonIn(const fs::path& file) {
    constexpr std::uintmax_t kMostBytes = 1U << 20U;
    const json object = json::parse(endOf(file, kMostBytes), nullptr, false);
    return object.is_object() ? object : json();
}

// As calibrate has left its figures.
void addKept(browser::Calibrations& list, const FileVersion& from) {
    browser::KeptCalibration& kept = *list.add_kept();
    kept.set_name(from.name);
    kept.set_in_use(from.isInUse);
    const json figures = json::parse(from.note, nullptr, false);
    if (!figures.is_object()) return;
    kept.set_verdict(textIn(figures, "verdict"));
    kept.set_cause(textIn(figures, "cause"));
    kept.set_overlap_rms_px(float(numberIn(figures, "overlap_rms_px")));
    kept.set_overlap_max_px(float(numberIn(figures, "overlap_max_px")));
    kept.set_absolute_rms_px(float(numberIn(figures, "absolute_rms_px")));
}

// As drift has left it beside the wall file; nothing where it never looked.
void addDrift(browser::Calibrations& list, fs::path wallFile) {
    const fs::path last = wallFile.replace_extension(".drift.last.json");
    const json look = jsonIn(last);
    if (look.is_null() || !look.contains("channels") || !look["channels"].is_array()) return;
    browser::Drift& drift = *list.mutable_drift();
    drift.set_looked(textIn(look, "looked"));
    drift.set_learned(textIn(look, "learned"));
    drift.set_camera_lost(look.value("camera_lost", json()) == true);
    drift.set_camera_moved_px(float(numberIn(look, "camera_moved_px")));
    for (const json& from : look["channels"]) {
        browser::ChannelDrift& channel = *drift.add_channels();
        channel.set_name(textIn(from, "name"));
        channel.set_verdict(textIn(from, "verdict"));
        channel.set_shift_px(float(numberIn(from, "shift_px")));
    }
}

// By all that the page filters by.
bool isWanted(const browser::LogRow& row, const browser::Look& look) {
    return (look.log_node().empty() || row.node() == look.log_node()) &&
           (!look.log_problems_only() || row.severity() != "info") &&
           row.text().find(look.log_text()) != std::string::npos;
}

// Nothing where the line is no object of JSON.
std::optional<browser::LogRow> rowOf(const std::string& line) {
    const json object = json::parse(line, nullptr, false);
    if (!object.is_object()) return std::nullopt;
    browser::LogRow row;
    row.set_time(textIn(object, "time"));
    row.set_node(textIn(object, "node"));
    row.set_severity(textIn(object, "severity"));
    row.set_text(textIn(object, "text"));
    const auto frame = object.find("frame");
    if (frame != object.end() && frame->is_number_unsigned())
        row.set_frame(frame->get<std::uint64_t>());
    return row;
}

}  // namespace

// The path at which the master's openLog() writes.
fs::path logOf(const std::string& rigPath) {
    return userFolder("XDG_STATE_HOME", ".local/state") / "logs" /
           (fs::path(rigPath).stem().string() + ".jsonl");
}

// Sorted, without their ending.
std::vector<std::string> scenesBeside(const std::string& rigPath, const std::string& scene) {
    std::vector<std::string> names;
    std::error_code failure;
    const fs::path folder = fs::path(config::besideFile(rigPath, scene)).parent_path();
    for (const auto& entry : fs::directory_iterator(folder, failure))
        if (entry.path().extension() == ".txtpb") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

// Of a long log only the last megabyte is read.
browser::LogTail tailOf(const fs::path& log, const browser::Look& look) {
    constexpr std::uintmax_t kMostBytes = 1U << 20U;
    constexpr std::size_t kMostRows = 300;
    std::deque<browser::LogRow> rows;
    for (const std::string& line : linesOf(endOf(log, kMostBytes))) {
        auto row = rowOf(line);
        if (!row || !isWanted(*row, look)) continue;
        rows.push_back(*std::move(row));
        if (rows.size() > kMostRows) rows.pop_front();
    }
    browser::LogTail tail;
    if (!fs::exists(log)) tail.set_problem("there is no log yet at " + log.string());
    for (browser::LogRow& row : rows) *tail.add_rows() = std::move(row);
    return tail;
}

// In a process of its own: it may hang on a network that does.
browser::DoctorReport askDoctor(const std::string& rigPath) {
    browser::DoctorReport report;
    const Said said = runAquarama({"doctor", rigPath, "--json"}, false);
    report.set_at_s(unixNow());
    const json list = json::parse(said.text, nullptr, false);
    if (!list.is_array()) {
        report.set_problem("the doctor gave no findings: run aquarama doctor in a terminal");
        return report;
    }
    for (const json& one : list) {
        browser::Finding& finding = *report.add_findings();
        finding.set_verdict(textIn(one, "verdict"));
        finding.set_subject(textIn(one, "subject"));
        finding.set_what(textIn(one, "what"));
        finding.set_todo(textIn(one, "todo"));
    }
    return report;
}

// A rig without a calibration has an empty list.
browser::Calibrations calibrationsOf(const std::string& rigPath) {
    browser::Calibrations list;
    try {
        const config::Rig rig = config::parseRig(config::readTextFile(rigPath), rigPath);
        list.set_file(rig.calibration);
        const std::string file =
            rig.calibration.empty() ? rigPath : config::besideFile(rigPath, rig.calibration);
        if (!rig.calibration.empty())
            for (const FileVersion& version : versionsOf(file)) addKept(list, version);
        addDrift(list, file);
    } catch (const std::exception& problem) {
        list.set_problem(problem.what());
    }
    return list;
}

// The program checks it with the whole rig before it puts it in place.
std::string useCalibration(const std::string& rigPath, const std::string& name) {
    const Said said = runAquarama({"calibrations", rigPath, "--use=" + name}, true);
    if (said.status == 0) return {};
    const std::vector<std::string> lines = linesOf(said.text);
    return lines.empty() ? "it could not be put in place" : lines.back();
}

// What somebody needs who helps from afar.
std::string bundleOf(const std::string& rigPath,
                     std::vector<std::pair<std::string, std::string>> files) {
    constexpr std::uintmax_t kMostBytes = std::uintmax_t{8} << 20U;
    const fs::path log = logOf(rigPath);
    for (const char* const suffix : {"", ".1", ".2"}) {
        const fs::path one = log.string() + suffix;
        if (fs::exists(one))
            files.emplace_back("log/" + one.filename().string(), endOf(one, kMostBytes));
    }
    files.emplace_back(fs::path(rigPath).filename().string(), endOf(rigPath, kMostBytes));
    std::vector<formats::ArchiveFile> archive;
    for (const auto& [name, text] : files) {
        const auto bytes = std::as_bytes(std::span{text});
        archive.emplace_back(name, std::vector(bytes.begin(), bytes.end()));
    }
    const std::vector<std::byte> bytes = formats::encodeArchive(archive);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// What cannot be read of the file is left out.
EventBook::EventBook(fs::path file) : file_{std::move(file)} {
    constexpr std::uintmax_t kMostBytes = 64U << 10U;
    for (const std::string& line : linesOf(endOf(file_, kMostBytes))) {
        const json object = json::parse(line, nullptr, false);
        if (!object.is_object() || !object.contains("at") || !object["at"].is_number()) continue;
        browser::Event& event = events_.emplace_front();
        event.set_at_s(object["at"].get<double>());
        event.set_who(textIn(object, "who"));
        event.set_what(textIn(object, "what"));
    }
    if (events_.size() > kMostEvents) events_.resize(kMostEvents);
}

// The newest first here, the newest last in the file.
void EventBook::add(const std::string& who, const std::string& what) {
    browser::Event& event = events_.emplace_front();
    event.set_at_s(unixNow());
    event.set_who(who);
    event.set_what(what);
    if (events_.size() > kMostEvents) events_.pop_back();
    const json line{{"at", event.at_s()}, {"who", who}, {"what", what}};
    try {
        GrowingFile(file_, GrowingFile::kAll)
            .append(line.dump(-1, ' ', false, json::error_handler_t::replace) + '\n');
    } catch (const Error& problem) {
        warnOnceOf(
            file_.parent_path(), problem.what(), "what is done is only listed until the end");
    }
}

// The newest event comes first.
browser::EventList EventBook::list() const {
    browser::EventList list;
    for (const browser::Event& event : events_) *list.add_events() = event;
    return list;
}

}  // namespace aquarama::console
