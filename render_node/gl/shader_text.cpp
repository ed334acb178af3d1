// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/shader_text.h"

#include <algorithm>
#include <regex>

namespace aquarama::gl {

namespace {

void addLine(ShaderText& shader, std::string_view line, std::string_view file, int number) {
    shader.text += line;
    if (!line.ends_with('\n')) shader.text += '\n';
    shader.sources.push_back({std::string(file), number});
}

std::string_view replaced(std::string_view file, const Replacements& replacements) {
    const auto found = std::ranges::find(replacements, file, &Replacement::file);
    return found == replacements.end() ? file : found->by;
}

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
    ShaderText shader;
    addLine(shader, "#version 450 core", name, 0);
    addFile(shader, name, read, replacements);
    return shader;
}

std::string withFiles(const std::string& log, const ShaderText& shader) {
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

}  // namespace aquarama::gl
