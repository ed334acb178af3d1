// SPDX-License-Identifier: Apache-2.0
#include "common/config/file_kind.h"

#include <array>
#include <vector>

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include "common/config/rig.pb.h"
#include "common/config/scene.pb.h"
#include "common/config/species.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

namespace pb = google::protobuf;

// What is wrong with the text is for its reader to say.
class Unheard : public pb::io::ErrorCollector {
    void AddError(int /*line*/, int /*column*/, const std::string& /*why*/) override {}
};

std::vector<std::string> outermostNames(const std::string& text) {
    pb::io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
    Unheard errors;
    pb::io::Tokenizer tokens(&stream, &errors);
    tokens.set_comment_style(pb::io::Tokenizer::SH_COMMENT_STYLE);
    std::vector<std::string> names;
    int depth = 0;
    while (tokens.Next()) {
        const std::string& token = tokens.current().text;
        if (token == "{" || token == "<") ++depth;
        if (token == "}" || token == ">") --depth;
        if (depth == 0 && tokens.current().type == pb::io::Tokenizer::TYPE_IDENTIFIER)
            names.push_back(token);
    }
    return names;
}

}  // namespace

FileKind fileKindOf(const std::string& text) {
    const std::array schemas{
        v1::Rig::descriptor(), v1::Scene::descriptor(), v1::Species::descriptor()};
    std::array<int, schemas.size()> known{};
    for (const std::string& name : outermostNames(text))
        for (std::size_t i = 0; i < schemas.size(); ++i)
            if (schemas[i]->FindFieldByName(name) != nullptr) ++known[i];
    std::size_t best = 0;
    for (std::size_t i = 1; i < schemas.size(); ++i)
        if (known[i] > known[best]) best = i;
    return static_cast<FileKind>(best);
}

FileKind fileKindAt(const std::string& path) {
    return fileKindOf(readTextFile(path));
}

}  // namespace aquarama::config
