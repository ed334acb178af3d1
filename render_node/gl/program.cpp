// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/program.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <optional>
#include <regex>
#include <span>

#include <epoxy/gl.h>

#include "common/base/derived_cache.h"
#include "common/base/log.h"

namespace aquarama::gl {

namespace {

// Called by the driver on the thread that made the OpenGL call. Notifications and messages of low
// severity are dropped.
void APIENTRY onMessage(GLenum /*source*/,
                        GLenum type,
                        GLuint /*id*/,
                        GLenum severity,
                        GLsizei length,
                        const GLchar* message,
                        const void* /*user*/) {
    const std::string_view text{message, static_cast<std::size_t>(length)};
    if (type == GL_DEBUG_TYPE_ERROR)
        logError("OpenGL: {}", text);
    else if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)
        logWarning("OpenGL: {}", text);
}

}  // namespace

void logMessages() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, nullptr);
}

Stage::Stage(const char* name) {
    assert(name != nullptr);
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
}

Stage::~Stage() {
    glPopDebugGroup();
}

namespace {

// Appends a line and its origin; keeps the invariant that text has sources.size() lines.
void addLine(ShaderText& shader, std::string_view line, std::string_view file, int number) {
    shader.text += line;
    if (!line.ends_with('\n')) shader.text += '\n';
    shader.sources.push_back({std::string(file), number});
}

// The file to include instead of `file`, or the file itself.
std::string_view replaced(std::string_view file, const Replacements& replacements) {
    const auto found = std::ranges::find(replacements, file, &Replacement::file);
    return found == replacements.end() ? file : found->by;
}

// Appends a file line by line and calls itself for each line that begins with #include. The files
// must not include one another in a cycle: guards are not evaluated here.
void addFile(ShaderText& shader,
             std::string_view name,
             const ReadShader& read,
             const Replacements& replacements) {
    constexpr std::string_view kInclude = "#include \"";
    std::string_view rest = read(name);
    for (int number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end);
        if (line.starts_with(kInclude))
            addFile(shader,
                    replaced(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()),
                             replacements),
                    read,
                    replacements);
        else
            addLine(shader, line, name, number);
    }
}

}  // namespace

ShaderText expand(std::string_view name, const ReadShader& read, const Replacements& replacements) {
    assert(read != nullptr);
    ShaderText shader;
    addLine(shader, "#version 450 core", name, 0);
    addFile(shader, name, read, replacements);
    return shader;
}

std::string withFiles(const std::string& log, const ShaderText& shader) {
    // At the start of a line: "0:12" or "0(12)", after an optional "ERROR: " or "WARNING: ". 0 is
    // the number of the source string; we pass one. Places outside the text stay as they are.
    static const std::regex kPlace(R"((^|\n)((?:ERROR: |WARNING: )?)0(?::(\d+)|\((\d+)\)))");
    std::string mapped;
    auto from = log.cbegin();
    for (std::sregex_iterator match(log.begin(), log.end(), kPlace), end; match != end; ++match) {
        const std::smatch& found = *match;
        const std::size_t line = std::stoul(found[3].matched ? found[3].str() : found[4].str());
        if (line < 1 || line > shader.sources.size()) continue;
        const ShaderText::Place& place = shader.sources[line - 1];
        mapped.append(from, found[0].first);
        mapped += found[1].str() + found[2].str() + place.file + ":" + std::to_string(place.line);
        from = found[0].second;
    }
    mapped.append(from, log.cend());
    return mapped;
}

namespace {

// A linear search: there are about 90 files, looked up only when programs are made.
const EmbeddedShader& embedded(std::string_view name) {
    const auto shaders = embeddedShaders();
    const auto found = std::ranges::find(shaders, name, &EmbeddedShader::name);
    if (found == shaders.end())
        throw Error("no shader file named \"" + std::string(name) + "\" in render_node/shaders");
    return *found;
}

GLenum stageOf(const std::string& file) {
    if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (file.ends_with(".frag")) return GL_FRAGMENT_SHADER;
    if (file.ends_with(".comp")) return GL_COMPUTE_SHADER;
    throw Error("shader file \"" + file + "\" must end in .vert, .frag or .comp");
}

bool isLinked(const ProgramHandle& program) {
    int linked = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    return linked != 0;
}

std::string trimmed(std::string log) {
    log.erase(log.find_last_not_of(" \n\t") + 1);
    return log;
}

// Compiles the expanded text. A log that is longer than 4096 bytes is cut: its first errors are the
// ones that matter.
ShaderHandle compiled(const std::string& file, const ShaderText& source) {
    const char* text = source.text.c_str();
    ShaderHandle shader{stageOf(file)};
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    int compiled = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == 0) {
        std::array<char, 4096> log{};
        glGetShaderInfoLog(shader.name(), log.size(), nullptr, log.data());
        throw Error("render_node/shaders/" + file +
                    " does not compile: " + trimmed(withFiles(log.data(), source)));
    }
    return shader;
}

// A shader of a program before it is compiled; the text is also part of the key of the cache.
struct ShaderStage {
    std::string file;
    ShaderText source;
};

// Compiles and links without the cache. The shader objects are deleted at once; the program keeps
// what it needs. The hint makes the driver keep a binary that can be read back.
ProgramHandle linked(std::span<const ShaderStage> stages) {
    assert(!stages.empty());
    ProgramHandle program;
    glProgramParameteri(program.name(), GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    for (const ShaderStage& stage : stages) {
        const auto shader = compiled(stage.file, stage.source);
        glAttachShader(program.name(), shader.name());
    }
    glLinkProgram(program.name());
    if (!isLinked(program)) {
        std::array<char, 4096> log{};
        glGetProgramInfoLog(program.name(), log.size(), nullptr, log.data());
        throw Error("render_node/shaders/" + stages.front().file + " does not link: " + log.data());
    }
    return program;
}

bool driverHasBinaries() {
    int formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    return formats > 0;
}

// Key of a binary in the cache: driver, version and all text, because a driver accepts only
// binaries that it wrote itself.
DerivedKey binaryKey(std::span<const ShaderStage> stages) {
    DerivedKey key("program");
    constexpr std::array<GLenum, 3> kNames{GL_VENDOR, GL_RENDERER, GL_VERSION};
    for (const GLenum name : kNames) key.add(reinterpret_cast<const char*>(glGetString(name)));
    for (const ShaderStage& stage : stages) key.add(stage.source.text);
    return key;
}

// The cached file: the driver's format number (4 bytes), then the binary.
std::vector<std::byte> binaryOf(const ProgramHandle& program) {
    int length = 0;
    glGetProgramiv(program.name(), GL_PROGRAM_BINARY_LENGTH, &length);
    GLenum format = 0;
    std::vector<std::byte> bytes(sizeof(format) + static_cast<std::size_t>(length));
    glGetProgramBinary(program.name(), length, nullptr, &format, bytes.data() + sizeof(format));
    std::memcpy(bytes.data(), &format, sizeof(format));
    return bytes;
}

// A program from a cached file; empty where the file is too short or the driver rejects it, as it
// may after an update.
std::optional<ProgramHandle> loaded(std::span<const std::byte> bytes) {
    GLenum format = 0;
    if (bytes.size() <= sizeof(format)) return std::nullopt;
    std::memcpy(&format, bytes.data(), sizeof(format));
    ProgramHandle program;
    const auto binary = bytes.subspan(sizeof(format));
    glProgramBinary(program.name(), format, binary.data(), static_cast<GLsizei>(binary.size()));
    if (!isLinked(program)) return std::nullopt;
    return program;
}

// Takes the program from the cache of derived data. Where the cache had to make it, the program is
// already linked; where a cached binary is rejected, it is linked again and not cached.
ProgramHandle linkedOrLoaded(std::span<const ShaderStage> stages) {
    if (!driverHasBinaries()) return linked(stages);
    std::optional<ProgramHandle> program;
    const auto bytes = derivedCache().find(binaryKey(stages), [&] {
        program = linked(stages);
        return binaryOf(*program);
    });
    if (!program) program = loaded(bytes);
    return program ? *std::move(program) : linked(stages);
}

// Tells programs apart, in debuggers too: "coral.vert coral.frag light_fine.glsl".
std::string labelOf(const std::vector<std::string>& shaderFiles, const Replacements& replacements) {
    std::string label = shaderFiles.front();
    for (auto file = shaderFiles.begin() + 1; file != shaderFiles.end(); ++file)
        label += " " + *file;
    for (const Replacement& replacement : replacements) label += " " + replacement.by;
    return label;
}

}  // namespace

ShaderHandle compileShader(const std::string& file,
                           const Replacements& replacements,
                           const ReadShader& read) {
    return compiled(file, expand(file, read, replacements));
}

std::string_view shaderSource(std::string_view name) {
    return embedded(name).text;
}

std::vector<std::string_view> shaderNames() {
    std::vector<std::string_view> names;
    for (const EmbeddedShader& shader : embeddedShaders()) names.push_back(shader.name);
    return names;
}

ProgramHandle makeProgram(const std::vector<std::string>& shaderFiles,
                          const Replacements& replacements) {
    assert(!shaderFiles.empty());
    std::vector<ShaderStage> stages;
    stages.reserve(shaderFiles.size());
    for (const std::string& file : shaderFiles)
        stages.push_back({file, expand(file, shaderSource, replacements)});
    ProgramHandle program = linkedOrLoaded(stages);
    glObjectLabel(GL_PROGRAM, program.name(), -1, labelOf(shaderFiles, replacements).c_str());
    return program;
}

}  // namespace aquarama::gl
