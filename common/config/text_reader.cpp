// SPDX-License-Identifier: Apache-2.0
#include "common/config/text_reader.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/config/rig.pb.h"
#include "common/config/rules.h"
#include "common/config/scene.pb.h"
#include "common/config/species.pb.h"

namespace aquarama::config {

namespace pb = google::protobuf;

namespace {

constexpr std::streamoff kMostBytes = 1 << 20;

// "CastMember" as "cast member".
std::string spelledOut(const std::string& type) {
    std::string words;
    for (const char letter : type) {
        const bool begins = letter >= 'A' && letter <= 'Z';
        if (begins && !words.empty()) words += ' ';
        words += begins ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    return words;
}

// What to do about an error of protobuf, by what it says; empty where that says it all.
std::string todoFor(const std::string& why) {
    constexpr std::array<std::pair<std::string_view, const char*>, 12> kTodo{{
        {" has no field named ", "; correct its name or remove it"},
        {"Expected string, got", ": put the text in quotes, \" \""},
        {"Expected integer, got", ": write a whole number, without quotes"},
        {"Expected double, got", ": write a number such as 2.5, without quotes"},
        {"Integer out of range", ": write a smaller number"},
        {"Unknown enumeration value", ": correct it; docs/reference.md has the choices"},
        {"Invalid value for boolean", ": write true or false"},
        {"Expected identifier, got", ": write the name of a field here, as in name: value"},
        {"Expected \":\"", ": write a : between the field and its value"},
        {"Expected \"}\"", ": close what a { before it opened"},
        {"Expected \"{\"", ": write the fields of this part between { and }"},
        {"is specified multiple times", ": leave one of them"},
    }};
    for (const auto& [said, todo] : kTodo)
        if (why.find(said) != std::string::npos) return todo;
    return "";
}

// What protobuf says, without the names of its types: who writes a file does not know them.
std::string inPlainWords(std::string why) {
    constexpr std::string_view kType = "\"aquarama.v1.";
    constexpr std::string_view kMessage = "Message type ";
    for (std::size_t at = 0; (at = why.find(kType)) != std::string::npos;) {
        const std::size_t name = at + kType.size();
        const std::size_t end = std::min(why.find('"', name), why.size());
        why.replace(at, end + 1 - at, spelledOut(why.substr(name, end - name)));
    }
    if (why.starts_with(kMessage)) why.erase(0, kMessage.size());
    if (why.ends_with('.')) why.pop_back();
    return why + todoFor(why);
}

class FirstError : public pb::io::ErrorCollector {
  public:
    FirstError(const std::string& source, const Columns& columns)
        : source_(source), columns_(columns) {}
    void AddError(int line, int column, const std::string& why) override {
        if (!text_.empty()) return;
        text_ = placed(source_, columns_.placeOf(line, column), legible(inPlainWords(why)));
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string source_;
    const Columns& columns_;
    std::string text_;
};

std::string shown(double value) {
    std::ostringstream out;
    out.precision(10);
    out << value;
    return out.str();
}

// "A, B or C", without the first, which says nothing.
std::string choicesOf(const pb::EnumDescriptor& type) {
    std::string list = type.value(1)->name();
    for (int i = 2; i < type.value_count(); ++i)
        list += (i + 1 < type.value_count() ? ", " : " or ") + type.value(i)->name();
    return list;
}

// "1 to 64", "5", "1 or more".
std::string countsOf(const v1::Rule& rule) {
    if (!rule.has_most()) return shown(rule.least()) + " or more";
    if (rule.least() == rule.most()) return shown(rule.most());
    return shown(rule.least()) + " to " + shown(rule.most());
}

const pb::FieldDescriptor& fieldNamed(const pb::Message& message, const std::string& name) {
    const pb::FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(name);
    assert(field != nullptr && "the code asks for a field that the schema lacks");
    return *field;
}

std::string lacks(const std::string& part, const std::string& field) {
    return part + " lacks " + field + ": add it";
}

// The path of a field of a part, as "open.0.from".
std::string pathOf(const std::string& part, const std::string& field) {
    return part.empty() ? field : part + "." + field;
}

// Errors in the text are its reader's to report.
class IgnoredErrors : public pb::io::ErrorCollector {
    void AddError(int /*line*/, int /*column*/, const std::string& /*why*/) override {}
};

// Calls visit(token) for each outside of all brackets, in order.
void eachOutermost(const std::string& text,
                   const std::function<void(const pb::io::Tokenizer::Token&)>& visit) {
    pb::io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
    IgnoredErrors errors;
    pb::io::Tokenizer tokens(&stream, &errors);
    tokens.set_comment_style(pb::io::Tokenizer::SH_COMMENT_STYLE);
    int depth = 0;
    while (tokens.Next()) {
        const std::string& token = tokens.current().text;
        if (token == "{" || token == "<") ++depth;
        if (token == "}" || token == ">") --depth;
        if (depth == 0) visit(tokens.current());
    }
}

std::vector<std::string> outermostNames(const std::string& text) {
    std::vector<std::string> names;
    eachOutermost(text, [&](const pb::io::Tokenizer::Token& token) {
        if (token.type == pb::io::Tokenizer::TYPE_IDENTIFIER) names.push_back(token.text);
    });
    return names;
}

constexpr const char* kVersion = "version";

// What a text says of its format is looked at before all else: what another one holds is unknown
// here, and the first unknown field would be a poor cause. A text that names none is of version 1.
// Throws Error.
void refuseOtherVersion(const std::string& text,
                        const std::string& source,
                        const Columns& columns,
                        const pb::Descriptor& type) {
    const pb::FieldDescriptor* field = type.FindFieldByName(kVersion);
    if (field == nullptr) return;
    const v1::Rule& rule = field->options().GetExtension(v1::rule);
    std::string said = "1";
    SourcePlace place{1, 1};
    std::string before;
    eachOutermost(text, [&](const pb::io::Tokenizer::Token& token) {
        if (token.text == ":") return;
        if (before == kVersion) {
            said = token.type == pb::io::Tokenizer::TYPE_INTEGER ? token.text : "";
            place = columns.placeOf(token.line, token.column);
        }
        before = token.text;
    });
    if (said.empty()) return;  // no whole number: the parser says so
    const double version = std::strtod(said.c_str(), nullptr);
    const std::string which = "version " + said + " of a " + spelledOut(type.name());
    if (version > rule.most())
        throw Error(placed(source,
                           place,
                           which + " is of a later release; this one reads up to version " +
                               shown(rule.most()) + ": update the programs"));
    if (rule.least() <= 1 || version >= rule.least()) return;
    assert(&type == v1::Species::descriptor() && "its page says what has changed");
    throw Error(placed(source,
                       place,
                       which + " is of an earlier release; this one reads version " +
                           countsOf(rule) + ": docs/species.md says what has changed"));
}

}  // namespace

std::string placed(const std::string& source, SourcePlace place, const std::string& why) {
    return source + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": " +
           why;
}

std::string readTextFile(const std::string& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
    if (size < 0 || size > kMostBytes)
        throw Error(path + ": cannot be read as a text file; check the path");
    std::string text(static_cast<std::size_t>(size), '\0');
    in.seekg(0);
    if (!in.read(text.data(), size))
        throw Error(path + ": reading failed; check that it is a file");
    return plainText(std::move(text), path);
}

std::string besideFile(const std::string& file, const std::string& path) {
    return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

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

TextReader::TextReader(const std::string& text, const std::string& source, Message& message)
    : TextReader(message, plainText(text, source), source) {}

TextReader::TextReader(Message& message, const std::string& text, std::string source)
    : source_(std::move(source)), message_(&message), columns_(text) {
    refuseOtherVersion(text, source_, columns_, *message.GetDescriptor());
    checkCharacters(text, source_);
    FirstError error(source_, columns_);
    pb::TextFormat::Parser parser;
    parser.RecordErrorsTo(&error);
    parser.WriteLocationsTo(&tree_);
    if (!parser.ParseFromString(text, &message)) throw Error(error.text());
}

// The pass over a file: notes where each part of the message stands, and its mistakes.
class TextReader::FilePass : public RulePass {
  public:
    explicit FilePass(TextReader& reader) : reader_{reader} {}

    std::vector<FileMistake> mistakes;

  private:
    void fault(const Message& message,
               const Field& field,
               const v1::Rule& rule,
               int index,
               RuleFault what) override;
    void enter(const Message& message,
               const Field& field,
               int index,
               const Message& inner) override;
    // In a file no text is empty, and each is what people can read.
    bool isGood(const std::string& text, const v1::Rule& rule) const override {
        return !text.empty() && faultOfQuoted(text).empty() && RulePass::isGood(text, rule);
    }

    TextReader& reader_;
};

void TextReader::check() {
    assert(parts_.empty() && "a file is checked once");
    fillDefaults(*message_);
    parts_.emplace(message_, Part{&tree_, {1, 1}, "the file", ""});
    FilePass pass(*this);
    pass.look(*message_);
    if (!pass.mistakes.empty()) throw FileError(source_, std::move(pass.mistakes));
}

void TextReader::fillDefaults(Message& message) {
    const pb::Reflection& get = *message.GetReflection();
    const pb::Descriptor& type = *message.GetDescriptor();
    for (int i = 0; i < type.field_count(); ++i) {
        const Field& field = *type.field(i);
        const std::string& value = field.options().GetExtension(v1::rule).default_value();
        if (!field.is_repeated() && !get.HasField(message, &field) && !value.empty()) {
            [[maybe_unused]] const bool filled =
                pb::TextFormat::ParseFieldValueFromString(value, &field, &message);
            assert(filled && "a default of the schema cannot be read");
        }
        if (field.cpp_type() != Field::CPPTYPE_MESSAGE) continue;
        for (int j = 0; field.is_repeated() && j < get.FieldSize(message, &field); ++j)
            fillDefaults(*get.MutableRepeatedMessage(&message, &field, j));
        if (!field.is_repeated() && get.HasField(message, &field))
            fillDefaults(*get.MutableMessage(&message, &field));
    }
}

void TextReader::FilePass::enter(const Message& message,
                                 const Field& field,
                                 int index,
                                 const Message& inner) {
    const Part& outer = reader_.partOf(message);
    const Tree* tree = outer.tree;
    if (tree != nullptr) tree = tree->GetTreeForNested(&field, field.is_repeated() ? index : -1);
    const std::string path = pathOf(outer.path, field.name());
    reader_.parts_.emplace(&inner,
                           Part{tree,
                                reader_.placeOf(message, field.name(), index),
                                field.name(),
                                field.is_repeated() ? path + "." + std::to_string(index) : path});
    look(inner);
}

void TextReader::FilePass::fault(
    const Message& message, const Field& field, const v1::Rule& rule, int index, RuleFault what) {
    const std::string& name = field.name();
    const std::string& part = reader_.partOf(message).name;
    std::string why;
    switch (what) {
        case RuleFault::Missing:
            why = lacks(part, name);
            break;
        case RuleFault::Count: {
            const int count = message.GetReflection()->FieldSize(message, &field);
            const bool few = rule.has_least() && count < rule.least();
            const std::string had = count == 0 ? " lacks " : " has " + std::to_string(count) + " ";
            why = part + had + name + ": give " + countsOf(rule);
            index = few ? 0 : static_cast<int>(rule.most());
            break;
        }
        case RuleFault::Text: {
            const std::string text = textIn(message, field, index);
            why = text.empty() ? "is empty: fill it in" : faultOfQuoted(text);
            why = name + " " + (why.empty() ? "is too long: shorten it" : why);
            break;
        }
        case RuleFault::Choice:
            why = name + " is " + field.enum_type()->value(0)->name() + ": write " +
                  choicesOf(*field.enum_type());
            break;
        case RuleFault::Number:
            why = name + " is " + shown(numberIn(message, field)) + ": it must be from " +
                  shown(rule.least()) + " to " + shown(rule.most());
    }
    mistakes.push_back(reader_.mistakeIn(message, name, why, index));
}

const TextReader::Part& TextReader::partOf(const Message& message) const {
    const auto found = parts_.find(&message);
    assert(found != parts_.end() && "no part of the checked message");
    return found->second;
}

SourcePlace TextReader::placeOf(const Message& part) const {
    return partOf(part).place;
}

SourcePlace TextReader::placeOf(const Message& part, const std::string& name, int index) const {
    const Part& known = partOf(part);
    const Field& field = fieldNamed(part, name);
    if (known.tree == nullptr) return known.place;
    const auto at = known.tree->GetLocation(&field, field.is_repeated() ? index : -1);
    return at.line < 0 ? known.place : columns_.placeOf(at.line, at.column);
}

void TextReader::require(const Message& part, const std::string& name) const {
    if (!part.GetReflection()->HasField(part, &fieldNamed(part, name)))
        refuse(part, name, lacks(partOf(part).name, name));
}

FileMistake TextReader::mistakeIn(const Message& part,
                                  const std::string& name,
                                  const std::string& why,
                                  int index) const {
    return {pathOf(partOf(part).path, name), placeOf(part, name, index), why};
}

void TextReader::refuse(const Message& part, const std::string& why) const {
    throw FileError(source_, {{partOf(part).path, placeOf(part), why}});
}

void TextReader::refuse(const Message& part,
                        const std::string& name,
                        const std::string& why,
                        int index) const {
    throw FileError(source_, {mistakeIn(part, name, why, index)});
}

}  // namespace aquarama::config
