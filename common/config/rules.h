// SPDX-License-Identifier: Apache-2.0
// One pass that holds a message to the rules of its schema (rules.proto): files of every kind, and
// what comes over the wire. Protobuf's types appear here, so only sources of common/config and
// common/wire may include this header.
#pragma once

#include <cstdint>
#include <string>

#include <google/protobuf/message.h>

#include "common/config/rules.pb.h"

namespace aquarama::config {

// What a field may have wrong.
enum class RuleFault : std::uint8_t {
    Missing,  // it is required
    Count,    // too few or too many entries
    Text,     // too short, too long, or with characters that are not allowed
    Choice,   // no value of its enum, or the unspecified one
    Number,   // outside its bounds, or not finite
};

// The pass. Whoever uses it says what becomes of a fault and of the messages inside.
class RulePass {
  public:
    // Names of protobuf's types.
    using Message = google::protobuf::Message;
    using Field = google::protobuf::FieldDescriptor;

    RulePass() = default;
    virtual ~RulePass() = default;
    RulePass(const RulePass&) = delete;
    RulePass& operator=(const RulePass&) = delete;

    // Looks at the fields of the message in the order of the schema, and calls fault() for each
    // that breaks its rule and enter() for each message inside.
    void look(const Message& message);

  protected:
    // `index`: of the entry of a repeated field.
    virtual void fault(const Message& message,
                       const Field& field,
                       const v1::Rule& rule,
                       int index,
                       RuleFault what) = 0;
    virtual void enter(const Message& message, const Field& field, int index, const Message& inner);
    // Whether a text keeps its rule.
    [[nodiscard]] virtual bool isGood(const std::string& text, const v1::Rule& rule) const;

  private:
    void lookAt(const Message& message, const Field& field, const v1::Rule& rule);
    void lookAtValue(const Message& message, const Field& field, const v1::Rule& rule, int index);
};

// Whether the message and all inside it keep their rules.
[[nodiscard]] bool keepsRules(const google::protobuf::Message& message);

// The value of a field, of any type of number, and of a text; an entry where it is repeated.
[[nodiscard]] double numberIn(const google::protobuf::Message& message,
                              const google::protobuf::FieldDescriptor& field,
                              int index = 0);
[[nodiscard]] std::string textIn(const google::protobuf::Message& message,
                                 const google::protobuf::FieldDescriptor& field,
                                 int index = 0);

}  // namespace aquarama::config
