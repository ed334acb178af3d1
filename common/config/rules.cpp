// SPDX-License-Identifier: Apache-2.0
#include "common/config/rules.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace aquarama::config {

namespace {

namespace pb = google::protobuf;
using Field = RulePass::Field;

using Ruled = std::pair<const Field*, const v1::Rule*>;

// The fields of a type with their rules. Looking up an extension of an option takes longer than the
// check, and a node's messages come some hundred times a second.
const std::vector<Ruled>& rulesOf(const pb::Descriptor& type) {
    thread_local std::unordered_map<const pb::Descriptor*, std::vector<Ruled>> known;
    auto& rules = known[&type];
    for (int i = static_cast<int>(rules.size()); i < type.field_count(); ++i)
        rules.emplace_back(type.field(i), &type.field(i)->options().GetExtension(v1::rule));
    return rules;
}

bool isPrinted(char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte >= 0x20 && byte != 0x7F;
}

int choiceIn(const pb::Message& message, const Field& field, int index) {
    const pb::Reflection& get = *message.GetReflection();
    return field.is_repeated() ? get.GetRepeatedEnumValue(message, &field, index)
                               : get.GetEnumValue(message, &field);
}

bool isWithin(double value, const v1::Rule& rule) {
    const bool isAbove = !rule.has_least() || value >= rule.least();
    const bool isBelow = !rule.has_most() || value <= rule.most();
    return std::isfinite(value) && isAbove && isBelow;
}

class FirstFault : public RulePass {
  public:
    bool found = false;

  private:
    void fault(const Message&, const Field&, const v1::Rule&, int, RuleFault) override {
        found = true;
    }
    void enter(const Message& message,
               const Field& field,
               int index,
               const Message& inner) override {
        if (!found) RulePass::enter(message, field, index, inner);
    }
};

}  // namespace

std::string textIn(const pb::Message& message, const Field& field, int index) {
    const pb::Reflection& get = *message.GetReflection();
    return field.is_repeated() ? get.GetRepeatedString(message, &field, index)
                               : get.GetString(message, &field);
}

double numberIn(const pb::Message& message, const Field& field, int index) {
    const pb::Reflection& get = *message.GetReflection();
    const auto value = [&](auto one, auto entry) {
        return static_cast<double>(field.is_repeated() ? (get.*entry)(message, &field, index)
                                                       : (get.*one)(message, &field));
    };
    using R = pb::Reflection;
    switch (field.cpp_type()) {
        case Field::CPPTYPE_DOUBLE:
            return value(&R::GetDouble, &R::GetRepeatedDouble);
        case Field::CPPTYPE_FLOAT:
            return value(&R::GetFloat, &R::GetRepeatedFloat);
        case Field::CPPTYPE_INT32:
            return value(&R::GetInt32, &R::GetRepeatedInt32);
        case Field::CPPTYPE_UINT32:
            return value(&R::GetUInt32, &R::GetRepeatedUInt32);
        case Field::CPPTYPE_INT64:
            return value(&R::GetInt64, &R::GetRepeatedInt64);
        default:
            assert(field.cpp_type() == Field::CPPTYPE_UINT64);
            return value(&R::GetUInt64, &R::GetRepeatedUInt64);
    }
}

void RulePass::look(const Message& message) {
    for (const auto& [field, rule] : rulesOf(*message.GetDescriptor()))
        lookAt(message, *field, *rule);
}

void RulePass::enter(const Message&, const Field&, int, const Message& inner) {
    look(inner);
}

bool RulePass::isGood(const std::string& text, const v1::Rule& rule) const {
    if (text.size() < rule.least_bytes()) return false;
    if (rule.has_most_bytes() && text.size() > rule.most_bytes()) return false;
    if (rule.printed() && !std::ranges::all_of(text, isPrinted)) return false;
    return !rule.ascii() ||
           std::ranges::all_of(text, [](char letter) { return letter >= ' ' && letter <= '~'; });
}

void RulePass::lookAt(const Message& message, const Field& field, const v1::Rule& rule) {
    const pb::Reflection& get = *message.GetReflection();
    if (!field.is_repeated() && !get.HasField(message, &field)) {
        if (rule.required()) fault(message, field, rule, 0, RuleFault::Missing);
        return;
    }
    const int count = field.is_repeated() ? get.FieldSize(message, &field) : 1;
    if (field.is_repeated() && !isWithin(count, rule))
        return fault(message, field, rule, 0, RuleFault::Count);
    // Of repeated numbers only the count has a rule; large ones are packed by the hundred thousand.
    const bool isNumbers =
        field.is_repeated() && field.is_packable() && field.cpp_type() != Field::CPPTYPE_ENUM;
    for (int i = 0; i < count && !isNumbers; ++i) lookAtValue(message, field, rule, i);
}

void RulePass::lookAtValue(const Message& message,
                           const Field& field,
                           const v1::Rule& rule,
                           int index) {
    const pb::Reflection& get = *message.GetReflection();
    switch (field.cpp_type()) {
        case Field::CPPTYPE_MESSAGE:
            return enter(message,
                         field,
                         index,
                         field.is_repeated() ? get.GetRepeatedMessage(message, &field, index)
                                             : get.GetMessage(message, &field));
        case Field::CPPTYPE_STRING:
            if (!isGood(textIn(message, field, index), rule))
                fault(message, field, rule, index, RuleFault::Text);
            return;
        case Field::CPPTYPE_ENUM: {
            const int choice = choiceIn(message, field, index);
            if (choice == 0 || field.enum_type()->FindValueByNumber(choice) == nullptr)
                fault(message, field, rule, index, RuleFault::Choice);
            return;
        }
        case Field::CPPTYPE_BOOL:
            return;
        default:
            if (!isWithin(numberIn(message, field, index), rule))
                fault(message, field, rule, index, RuleFault::Number);
    }
}

bool keepsRules(const pb::Message& message) {
    FirstFault pass;
    pass.look(message);
    return !pass.found;
}

}  // namespace aquarama::config
