// SPDX-License-Identifier: Apache-2.0
#include "common/formats/archive.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <ctime>
#include <set>

#include <zip.h>

#include "common/base/characters.h"
#include "common/base/log.h"

namespace aquarama::formats {

namespace {

// Deflate packs at most 1032 bytes into one: an entry that claims more has a false size.
constexpr std::uint64_t kMostRatio = 1100;
constexpr std::size_t kMostNameBytes = 512;
// 1980-01-02, which the clock of a zip can say in every time zone.
constexpr std::time_t kTimeOfEntries = 315619200;
// The least level: higher ones hardly make floats smaller.
constexpr zip_uint32_t kCompression = 1;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool isControl(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

bool isAbsolute(std::string_view name) {
    return name.front() == '/' || (name.size() > 1 && name[1] == ':');
}

bool leadsOut(std::string_view name) {
    return ("/" + std::string(name) + "/").find("/../") != std::string::npos;
}

// What is wrong with the name of an entry; null: nothing.
const char* wrongWith(std::string_view name) {
    if (name.empty()) return "is empty";
    if (name.size() > kMostNameBytes) return "is too long";
    if (std::ranges::any_of(name, isControl)) return "has control characters";
    if (isAbsolute(name)) return "is absolute";
    return leadsOut(name) ? "leads out of the archive" : nullptr;
}

// Some programs of Windows pack names with backslashes.
std::string withSlashes(std::string name) {
    std::ranges::replace(name, '\\', '/');
    while (name.starts_with("./") && name.size() > 2) name.erase(0, 2);
    return name;
}

struct CloseEntry {
    void operator()(zip_file_t* file) const { (void)zip_fclose(file); }
};

std::string messageOf(zip_error_t& error) {
    std::string message = zip_error_strerror(&error);
    zip_error_fini(&error);
    return message;
}

// An archive that is being made in memory, and thrown away unless it is taken.
class NewArchive {
  public:
    NewArchive() {
        zip_error_t error{};
        source_ = zip_source_buffer_create(nullptr, 0, 1, &error);
        if (source_ != nullptr) zip_ = zip_open_from_source(source_, ZIP_TRUNCATE, &error);
        if (zip_ == nullptr) {
            zip_source_free(source_);
            throw Error("an archive cannot be made: " + messageOf(error) + "; is memory short?");
        }
        zip_source_keep(source_);
    }
    ~NewArchive() {
        if (zip_ != nullptr) zip_discard(zip_);
        zip_source_free(source_);
    }
    NewArchive(const NewArchive&) = delete;
    NewArchive& operator=(const NewArchive&) = delete;

    // The file must be there until the archive is taken.
    void add(const ArchiveFile& file) {
        const auto& [name, bytes] = file;
        zip_source_t* content = zip_source_buffer(zip_, bytes.data(), bytes.size(), 0);
        const zip_int64_t index = zip_file_add(zip_, name.c_str(), content, ZIP_FL_ENC_UTF_8);
        if (index < 0) {
            zip_source_free(content);
            fail();
        }
        const auto at = static_cast<zip_uint64_t>(index);
        (void)zip_set_file_compression(zip_, at, ZIP_CM_DEFLATE, kCompression);
        (void)zip_file_set_mtime(zip_, at, kTimeOfEntries, 0);
    }

    [[nodiscard]] std::vector<std::byte> take() {
        if (zip_close(zip_) != 0) fail();
        zip_ = nullptr;
        zip_stat_t stat{};
        if (zip_source_stat(source_, &stat) != 0 || zip_source_open(source_) != 0) fail();
        std::vector<std::byte> bytes(stat.size);
        const zip_int64_t count = zip_source_read(source_, bytes.data(), bytes.size());
        (void)zip_source_close(source_);
        if (count != static_cast<zip_int64_t>(bytes.size())) fail();
        return bytes;
    }

  private:
    [[noreturn]] void fail() const {
        const std::string why = zip_ != nullptr ? zip_strerror(zip_) : "reading it back failed";
        throw Error("an archive cannot be made: " + why);
    }
    zip_source_t* source_ = nullptr;
    zip_t* zip_ = nullptr;
};

}  // namespace

struct Archive::Zip {
    zip_t* zip = nullptr;
    ~Zip() {
        if (zip != nullptr) zip_discard(zip);
    }
};

Archive::Archive(std::span<const std::byte> bytes, std::string source)
    : zip_(std::make_unique<Zip>()), source_(std::move(source)) {
    zip_error_t error{};
    zip_source_t* content = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (content != nullptr) zip_->zip = zip_open_from_source(content, ZIP_RDONLY, &error);
    if (zip_->zip == nullptr) {
        zip_source_free(content);
        throw Error(source_ + ": is no whole zip archive (" + messageOf(error) +
                    "); copy or export it anew");
    }
    listNames();
}

Archive::~Archive() = default;

void Archive::listNames() {
    const zip_int64_t count = zip_get_num_entries(zip_->zip, 0);
    if (count > kMostEntries)
        throw Error(
            fmt::format("{}: has {} entries, more than the {} that are read; export only "
                        "what the wall needs",
                        source_,
                        count,
                        kMostEntries));
    std::set<std::string> seen;
    for (zip_int64_t i = 0; i < count; ++i) {
        const char* raw = zip_get_name(zip_->zip, static_cast<zip_uint64_t>(i), 0);
        const std::string name = withSlashes(raw != nullptr ? raw : "");
        const char* wrong = wrongWith(name);
        if (wrong == nullptr && !seen.insert(lowered(name)).second) wrong = "is there twice";
        if (wrong != nullptr)
            throw Error(fmt::format("{}: the name of its entry \"{}\" {}; pack it anew",
                                    source_,
                                    printable(name),
                                    wrong));
        if (name.back() == '/') continue;
        names_.push_back(name);
        indices_.push_back(static_cast<std::uint64_t>(i));
    }
}

std::optional<std::string> Archive::find(std::string_view name) const {
    if (name.starts_with("./")) name.remove_prefix(2);
    const auto found = std::ranges::find_if(
        names_, [&](const std::string& known) { return sameName(known, name); });
    if (found == names_.end()) return std::nullopt;
    return *found;
}

std::uint64_t Archive::sizeToRead(std::uint64_t size, std::uint64_t packed) const {
    const std::uint64_t most = std::min(kMostEntryBytes, kMostArchiveBytes - readBytes_);
    if (size > most)
        throw Error(fmt::format(
            "claims {} bytes, more than the {} that are read; make it smaller", size, most));
    if (size / kMostRatio > packed)
        throw Error(fmt::format(
            "claims {} bytes of {}, which no zip can hold; export it anew", size, packed));
    return size;
}

std::vector<std::byte> Archive::read(const std::string& name) try {
    zip_stat_t stat{};
    const auto known = std::ranges::find(names_, name);
    assert(known != names_.end() && "no name of this archive");
    const std::uint64_t index = indices_[static_cast<std::size_t>(known - names_.begin())];
    if (zip_stat_index(zip_->zip, index, 0, &stat) != 0) throw Error("is damaged; export it anew");
    std::vector<std::byte> bytes(sizeToRead(stat.size, stat.comp_size));
    const std::unique_ptr<zip_file_t, CloseEntry> file(zip_fopen_index(zip_->zip, index, 0));
    if (!file)
        throw Error(fmt::format("cannot be read ({}); pack it anew", zip_strerror(zip_->zip)));
    std::byte beyond{};
    // The read beyond the end is the one that compares the checksum.
    if (zip_fread(file.get(), bytes.data(), bytes.size()) !=
            static_cast<zip_int64_t>(bytes.size()) ||
        zip_fread(file.get(), &beyond, 1) != 0)
        throw Error("is damaged; copy or export it anew");
    readBytes_ += stat.size;
    return bytes;
} catch (const Error& error) {
    throw Error(fmt::format("{}: its entry \"{}\" {}", source_, printable(name), error.what()));
}

bool isArchive(std::span<const std::byte> bytes) {
    constexpr std::array<const char*, 3> kBeginnings{"PK\x03\x04", "PK\x05\x06", "PK\x07\x08"};
    return bytes.size() >= 4 && std::ranges::any_of(kBeginnings, [&](const char* beginning) {
               return std::memcmp(bytes.data(), beginning, 4) == 0;
           });
}

std::vector<std::byte> encodeArchive(const std::vector<ArchiveFile>& files) {
    NewArchive archive;
    for (const ArchiveFile& file : files) {
        const bool hasBackslash = file.first.find('\\') != std::string::npos;
        if (const char* wrong = hasBackslash ? "has a backslash" : wrongWith(file.first))
            throw Error(fmt::format("the name \"{}\" for an archive {}; give it another",
                                    printable(file.first),
                                    wrong));
        archive.add(file);
    }
    return archive.take();
}

std::string lowered(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), lower);
    return result;
}

bool sameName(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, lower, lower);
}

std::string printable(std::string_view text) {
    constexpr std::size_t kMost = 120;
    std::string line(text.substr(0, kMost));
    std::ranges::replace_if(line, isControl, ' ');
    line = legible(line);
    return text.size() > kMost ? line + "..." : line;
}

}  // namespace aquarama::formats
