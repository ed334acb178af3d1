// SPDX-License-Identifier: Apache-2.0
#include "common/config/text_reader.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

#include <google/protobuf/io/tokenizer.h>

#include "common/units/log.h"

namespace aquarama::config {

namespace pb = google::protobuf;

namespace {

constexpr std::streamoff kMostBytes = 4 << 20;  // a large rig or species takes some 10 KB

// Protobuf counts lines and columns from 0, editors from 1.
SourcePlace counted(int line, int column) {
    return {line + 1, column + 1};
}

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
    if (why.find(" has no field named ") != std::string::npos)
        why += "; correct its name or remove it";
    return why;
}

class FirstError : public pb::io::ErrorCollector {
  public:
    explicit FirstError(const std::string& source) : source_(source) {}
    void AddError(int line, int column, const std::string& why) override {
        if (!text_.empty()) return;
        text_ = placed(source_, counted(line, column), inPlainWords(why));
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string source_;
    std::string text_;
};

std::string shown(double value) {
    std::ostringstream out;
    out.precision(10);
    out << value;
    return out.str();
}

// The numeric value of a field of any numeric type.
double numberIn(const pb::Message& message, const pb::FieldDescriptor& field, int index) {
    const pb::Reflection& get = *message.GetReflection();
    const bool many = field.is_repeated();
    switch (field.cpp_type()) {
        case pb::FieldDescriptor::CPPTYPE_DOUBLE:
            return many ? get.GetRepeatedDouble(message, &field, index)
                        : get.GetDouble(message, &field);
        case pb::FieldDescriptor::CPPTYPE_FLOAT:
            return static_cast<double>(many ? get.GetRepeatedFloat(message, &field, index)
                                            : get.GetFloat(message, &field));
        case pb::FieldDescriptor::CPPTYPE_INT32:
            return many ? get.GetRepeatedInt32(message, &field, index)
                        : get.GetInt32(message, &field);
        default:
            assert(field.cpp_type() == pb::FieldDescriptor::CPPTYPE_UINT32);
            return many ? get.GetRepeatedUInt32(message, &field, index)
                        : get.GetUInt32(message, &field);
    }
}

}  // namespace

std::string readTextFile(const std::string& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
    if (size < 0 || size > kMostBytes)
        throw Error(path + ": cannot be read as a text file; check the path");
    std::string text(static_cast<std::size_t>(size), '\0');
    in.seekg(0);
    if (!in.read(text.data(), size))
        throw Error(path + ": reading failed; check that it is a file");
    return text;
}

TextReader::TextReader(const std::string& text, std::string source, pb::Message& message)
    : source_(std::move(source)), message_(&message) {
    FirstError error(source_);
    pb::TextFormat::Parser parser;
    parser.RecordErrorsTo(&error);
    parser.WriteLocationsTo(&tree_);
    if (!parser.ParseFromString(text, &message)) throw Error(error.text());
}

TextPlace TextReader::root() const {
    TextPlace place;
    place.message_ = message_;
    place.tree_ = &tree_;
    place.source_ = &source_;
    place.name_ = "the file";
    return place;
}

const TextPlace::Field& TextPlace::fieldNamed(const std::string& name) const {
    const Field* field = message_->GetDescriptor()->FindFieldByName(name);
    assert(field != nullptr && "the code asks for a field that the schema lacks");
    return *field;
}

const TextPlace::Field& TextPlace::present(const std::string& name, int index) const {
    const Field& field = fieldNamed(name);
    assert(field.is_repeated() == (index != kSingle));
    const bool there = field.is_repeated() ? index < count(name) : has(name);
    if (!there) refuse(name_ + " lacks " + name + ": add it");
    return field;
}

bool TextPlace::has(const std::string& field) const {
    return message_->GetReflection()->HasField(*message_, &fieldNamed(field));
}

int TextPlace::count(const std::string& field) const {
    return message_->GetReflection()->FieldSize(*message_, &fieldNamed(field));
}

TextPlace TextPlace::in(const std::string& name, int index) const {
    const Field& field = present(name, index);
    const pb::Reflection& get = *message_->GetReflection();
    TextPlace inner;
    inner.message_ = field.is_repeated() ? &get.GetRepeatedMessage(*message_, &field, index)
                                         : &get.GetMessage(*message_, &field);
    inner.tree_ = tree_->GetTreeForNested(&field, index);
    inner.source_ = source_;
    inner.name_ = name;
    const auto at = tree_->GetLocation(&field, index);
    inner.line_ = at.line + 1;
    inner.column_ = at.column + 1;
    return inner;
}

double TextPlace::number(const std::string& name, Range range, int index) const {
    const double value = numberIn(*message_, present(name, index), index);
    if (!(value >= range.low && value <= range.high))  // also refuses nan
        refuse(name,
               name + " is " + shown(value) + ": it must be from " + shown(range.low) + " to " +
                   shown(range.high),
               index);
    return value;
}

double TextPlace::numberOr(const std::string& name, Range range, double fallback) const {
    return has(name) ? number(name, range) : fallback;
}

bool TextPlace::truth(const std::string& name) const {
    return message_->GetReflection()->GetBool(*message_, &present(name, kSingle));
}

std::string TextPlace::text(const std::string& name, int index) const {
    const Field& field = present(name, index);
    const pb::Reflection& get = *message_->GetReflection();
    std::string value = field.is_repeated() ? get.GetRepeatedString(*message_, &field, index)
                                            : get.GetString(*message_, &field);
    if (value.empty()) refuse(name, name + " is empty: fill it in", index);
    return value;
}

std::string TextPlace::choice(const std::string& name) const {
    return message_->GetReflection()->GetEnum(*message_, &present(name, kSingle))->name();
}

SourcePlace TextPlace::placeOf(const std::string& name) const {
    const Field& field = fieldNamed(name);
    const auto at = tree_->GetLocation(&field, field.is_repeated() ? 0 : kSingle);
    return counted(at.line, at.column);
}

void TextPlace::refuse(const std::string& name, const std::string& why, int index) const {
    const Field& field = fieldNamed(name);
    if (field.is_repeated()) index = std::max(index, 0);
    const bool there = field.is_repeated() ? index < count(name) : has(name);
    if (!there) refuse(why);
    const auto at = tree_->GetLocation(&field, index);
    throw Error(placed(*source_, counted(at.line, at.column), why));
}

void TextPlace::refuse(const std::string& why) const {
    throw Error(placed(*source_, place(), why));
}

}  // namespace aquarama::config
