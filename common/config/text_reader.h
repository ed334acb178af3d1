// SPDX-License-Identifier: Apache-2.0
// Reads a protobuf text file and names file:line:column for whatever is wrong with it. Protobuf's
// types appear here, so only .cpp files of common/config may include this header.
#pragma once

#include <cstdint>
#include <string>

#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include "common/config/source_place.h"

namespace aquarama::config {

// The whole file; throws Error when it cannot be read or is larger than any configuration is.
[[nodiscard]] std::string readTextFile(const std::string& path);

struct Range {
    double low = 0;
    double high = 0;
};

// One message of a text, and where it and each of its fields stand. Each getter throws Error with
// the place when the field is missing or its value is refused. An index is given for repeated
// fields only.
class TextPlace {
  public:
    static constexpr int kSingle = -1;

    [[nodiscard]] bool has(const std::string& field) const;
    [[nodiscard]] int count(const std::string& field) const;
    [[nodiscard]] TextPlace in(const std::string& field, int index = kSingle) const;

    // Of any numeric type; finite and inside the range.
    [[nodiscard]] double number(const std::string& field, Range range, int index = kSingle) const;
    [[nodiscard]] double numberOr(const std::string& field, Range range, double fallback) const;
    [[nodiscard]] bool truth(const std::string& field) const;
    // Set, and not empty.
    [[nodiscard]] std::string text(const std::string& field, int index = kSingle) const;
    // The name of the enumeration's value.
    [[nodiscard]] std::string choice(const std::string& field) const;

    [[nodiscard]] SourcePlace place() const { return {line_, column_}; }
    // Of a field that is there; of a repeated one, its first.
    [[nodiscard]] SourcePlace placeOf(const std::string& field) const;

    // Throws Error "file:line:column: why", placed at the field if it is there (a repeated one
    // without an index: at its first), else at the message.
    [[noreturn]] void refuse(const std::string& field,
                             const std::string& why,
                             int index = kSingle) const;
    [[noreturn]] void refuse(const std::string& why) const;

  private:
    friend class TextReader;
    using Tree = google::protobuf::TextFormat::ParseInfoTree;
    using Field = google::protobuf::FieldDescriptor;

    TextPlace() = default;
    [[nodiscard]] const Field& fieldNamed(const std::string& name) const;
    [[nodiscard]] const Field& present(const std::string& name, int index) const;

    const google::protobuf::Message* message_ = nullptr;
    const Tree* tree_ = nullptr;
    const std::string* source_ = nullptr;
    std::string name_;  // of this message, as a reader of the file knows it
    int line_ = 1;
    int column_ = 1;
};

// Parses `text` into `message`, which must outlive it; throws Error with source:line:column at the
// first thing that the schema does not allow, an unknown field among them.
class TextReader {
  public:
    TextReader(const std::string& text, std::string source, google::protobuf::Message& message);
    [[nodiscard]] TextPlace root() const;

  private:
    std::string source_;
    const google::protobuf::Message* message_;
    google::protobuf::TextFormat::ParseInfoTree tree_;
};

}  // namespace aquarama::config
