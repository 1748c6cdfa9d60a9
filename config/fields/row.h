// A key and the struct member that it fills.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "config/fields/field_value.h"
#include "config/fields/fields.h"
#include "config/text/quantity.h"

namespace skybake::config {

template <class T>
concept SiQuantity = std::same_as<T, Length> || std::same_as<T, InverseLength> ||
    std::same_as<T, NumberDensity> || std::same_as<T, Angle>;

// One value of a field into a member. Both come from the same row, so they fit.
template <class T>
void assign(const Field&, const FieldValue& value, T& member) {
    member = std::get<T>(value);
}

inline void assign(const Field&, const FieldValue& value, int& member) {
    member = static_cast<int>(std::get<double>(value));
}

template <SiQuantity T>
void assign(const Field&, const FieldValue& value, T& member) {
    member = T{std::get<double>(value)};
}

template <SiQuantity T, std::size_t count>
void assign(const Field&, const FieldValue& value, std::array<T, count>& member) {
    const auto& numbers = std::get<std::array<double, count>>(value);
    for (std::size_t i = 0; i < count; ++i) member[i] = T{numbers[i]};
}

template <SiQuantity T>
void assign(const Field&, const FieldValue& value, std::vector<T>& member) {
    member.clear();
    for (const double number : std::get<std::vector<double>>(value)) member.push_back(T{number});
}

template <class T>
void assign(const Field&, const FieldValue& value, std::optional<T>& member) {
    member = std::get<T>(value);
}

template <class T>
requires std::is_enum_v<T>
void assign(const Field& field, const FieldValue& value, T& member) {
    member = static_cast<T>(field.choices[std::get<ChoiceIndex>(value).index].enumerator);
}

template <class T>
requires std::is_enum_v<T>
void assign(const Field& field, const FieldValue& value, std::vector<T>& member) {
    member.clear();
    for (const ChoiceIndex choice : std::get<std::vector<ChoiceIndex>>(value)) {
        member.push_back(static_cast<T>(field.choices[choice.index].enumerator));
    }
}

// A key of a section with struct S.
template <class S>
struct Row {
    Field field;
    // The member, whatever its type, and what assigns to one of that type; null where the value is
    // used otherwise.
    char S::*member = nullptr;
    void (*assign_to)(S& target, char S::*member, const Field& field,
                      const FieldValue& value) = nullptr;

    Row(const Field& key, std::nullptr_t) : field(key) {}

    template <class T, class Base>
    requires std::is_base_of_v<Base, S> Row(const Field& key, T Base::*of_base)
        : field(key),
          member(reinterpret_cast<char S::*>(static_cast<T S::*>(of_base))),
          assign_to([](S& target, char S::*any, const Field& of, const FieldValue& value) {
              assign(of, value, target.*reinterpret_cast<T S::*>(any));
          }) {}

    void fill(S& target, const FieldValue& value) const {
        if (assign_to) assign_to(target, member, field, value);
    }
};

}  // namespace skybake::config
