// SPDX-License-Identifier: Apache-2.0
// Parses a text file into a message of our schemas, holds it to their rules (rules.proto), and
// names file:line:column for whatever is wrong with it. Protobuf's types appear here, so only .cpp
// files of common/config may include this header.
#pragma once

#include <string>
#include <unordered_map>

#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include "common/config/plain_text.h"
#include "common/config/text_file.h"

namespace aquarama::config {

// First check() the message, then make a struct of it; what no single field can tell is refused
// meanwhile, by a reference to the part of the message where it is wrong. Every error is an Error
// "file:line:column: what is wrong: what to do"; from check() on it is a FileError with the fields.
class TextReader {
  public:
    // The name of protobuf's type.
    using Message = google::protobuf::Message;

    // Parses `text` into `message`, which must outlive the reader. `source` is the file's name in
    // errors. Throws Error at the first character that is of no text file of ours (plain_text.h),
    // and at the first thing that the schema does not allow, an unknown field among them.
    TextReader(const std::string& text, const std::string& source, Message& message);

    // Fills in the defaults of what is left out and holds every field to its rule: required fields,
    // bounds, numbers of entries; no text is empty and no choice unspecified. Throws all mistakes
    // at once. Once, before all that follows.
    void check();

    // `part` is the checked message or one inside it; a field is named as in the schema.
    [[nodiscard]] SourcePlace placeOf(const Message& part) const;
    // Of a field that the file has, else of the part.
    [[nodiscard]] SourcePlace placeOf(const Message& part,
                                      const std::string& field,
                                      int index = 0) const;
    // For a field that only some files must have.
    void require(const Message& part, const std::string& field) const;
    [[noreturn]] void refuse(const Message& part, const std::string& why) const;
    // At the field, where the file has it; of a repeated one, at its entry `index`.
    [[noreturn]] void refuse(const Message& part,
                             const std::string& field,
                             const std::string& why,
                             int index = 0) const;

  private:
    // Of a text that is plain.
    TextReader(Message& message, const std::string& text, std::string source);

    using Tree = google::protobuf::TextFormat::ParseInfoTree;
    using Field = google::protobuf::FieldDescriptor;
    // Of a message: where it stands, and its fields.
    struct Part {
        const Tree* tree = nullptr;  // null where a default was filled in
        SourcePlace place;
        std::string name;  // as a reader of the file knows it
        std::string path;  // "open.0"; empty: the whole file
    };

    class FilePass;
    static void fillDefaults(Message& message);
    [[nodiscard]] const Part& partOf(const Message& message) const;
    // A mistake in a field; of a repeated one, at its entry `index`.
    [[nodiscard]] FileMistake mistakeIn(const Message& part,
                                        const std::string& field,
                                        const std::string& why,
                                        int index = 0) const;

    std::string source_;
    Message* message_;
    Columns columns_;
    Tree tree_;
    std::unordered_map<const Message*, Part> parts_;
};

}  // namespace aquarama::config
