// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/program.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "common/units/error.h"
#include "render_node/gl/embedded_shaders.h"

namespace aquarama::gl {

namespace {

thread_local std::string definitions;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

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

std::string trimmed(std::string log) {
    log.erase(log.find_last_not_of(" \n\t") + 1);
    return log;
}

// After the #version, which comes first; the lines of the files keep their places.
void addDefinitions(ShaderText& shader, const std::string& file) {
    shader.text.insert(shader.text.find('\n') + 1, definitions);
    const auto lines = static_cast<std::size_t>(std::ranges::count(definitions, '\n'));
    shader.sources.insert(shader.sources.begin() + 1, lines, {file, 0});
}

}  // namespace

Definitions::Definitions(std::string lines)
    : outer_{std::exchange(definitions, std::move(lines))} {}

Definitions::~Definitions() {
    definitions = std::move(outer_);
}

ShaderHandle compileShader(const std::string& file,
                           std::span<const Replacement> replacements,
                           const ReadShader& read) {
    ShaderText source = expand(file, read, replacements);
    addDefinitions(source, file);
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

std::string_view shaderSource(std::string_view name) {
    return embedded(name).text;
}

std::vector<std::string_view> shaderNames() {
    std::vector<std::string_view> names;
    for (const EmbeddedShader& shader : embeddedShaders()) names.push_back(shader.name);
    return names;
}

ProgramHandle makeProgram(const std::vector<std::string>& shaderFiles,
                          std::span<const Replacement> replacements) {
    ProgramHandle program;
    for (const std::string& file : shaderFiles) {
        const auto shader = compileShader(file, replacements);
        glAttachShader(program.name(), shader.name());
    }
    glLinkProgram(program.name());
    int linked = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == 0) {
        std::array<char, 4096> log{};
        glGetProgramInfoLog(program.name(), log.size(), nullptr, log.data());
        throw Error("render_node/shaders/" + shaderFiles.front() + " does not link: " + log.data());
    }
    glObjectLabel(GL_PROGRAM, program.name(), -1, shaderFiles.front().c_str());
    return program;
}

}  // namespace aquarama::gl
