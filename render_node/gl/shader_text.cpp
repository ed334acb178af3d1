// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/shader_text.h"

#include <algorithm>
#include <regex>

namespace aquarama::gl {

namespace {

class Expander {
  public:
    explicit Expander(const ReadShader& read) : read_{read} {
        shader_.text = "#version 450 core\n";
    }

    void add(std::string_view name) {
        constexpr std::string_view kInclude = "#include \"";
        const std::size_t file = shader_.files.size();
        shader_.files.emplace_back(name);
        say(1, file);
        std::string_view rest = read_(name);
        for (int line = 1; !rest.empty(); ++line) {
            const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
            const std::string_view text = rest.substr(0, end);
            rest.remove_prefix(end);
            if (text.starts_with(kInclude)) {
                add(text.substr(kInclude.size(), text.rfind('"') - kInclude.size()));
                say(line + 1, file);
            } else {
                shader_.text += text;
            }
        }
        if (!shader_.text.ends_with('\n')) shader_.text += '\n';
    }
    [[nodiscard]] ShaderText take() { return std::move(shader_); }

  private:
    // The number of the line that follows.
    void say(int line, std::size_t file) {
        shader_.text += "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
    }

    const ReadShader& read_;
    ShaderText shader_;
};

}  // namespace

ShaderText expand(std::string_view name, const ReadShader& read) {
    Expander expander(read);
    expander.add(name);
    return expander.take();
}

std::string withFiles(const std::string& log, const std::vector<std::string>& files) {
    static const std::regex kPlace(R"((^|\n)((?:ERROR: |WARNING: )?)(\d+)(?::(\d+)|\((\d+)\)))");
    std::string mapped;
    auto from = log.cbegin();
    for (std::sregex_iterator match(log.begin(), log.end(), kPlace), end; match != end; ++match) {
        const std::smatch& place = *match;
        mapped.append(from, place[0].first);
        from = place[0].second;
        const std::size_t file = std::stoul(place[3].str());
        const std::string name = file < files.size() ? files[file] : place[3].str();
        const std::string line = place[4].matched ? place[4].str() : place[5].str();
        mapped += place[1].str() + place[2].str() + name + ":" + line;
    }
    mapped.append(from, log.cend());
    return mapped;
}

}  // namespace aquarama::gl
