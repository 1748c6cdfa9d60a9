// Headers of EXR files, read byte by byte.
#pragma once

#include <string>
#include <vector>

#include "tests/io/files.h"

namespace skybake::testing {

// An attribute of a header: its value are `size` bytes at `at`, behind four that hold the size.
struct ExrAttribute {
    std::string name, type;
    std::size_t at = 0, size = 0;

    std::size_t end() const { return at + size; }
};

inline std::vector<ExrAttribute> exr_attributes(const std::string& file) {
    std::vector<ExrAttribute> attributes;
    for (std::size_t at = 8; at < file.size() && file[at] != 0; at = attributes.back().end()) {
        const std::string name = file.c_str() + at;
        const std::string type = file.c_str() + at + name.size() + 1;
        at += name.size() + type.size() + 2;
        attributes.push_back({name, type, at + 4, word(file, at)});
    }
    return attributes;
}

inline ExrAttribute exr_attribute(const std::string& file, const std::string& name) {
    for (const ExrAttribute& attribute : exr_attributes(file)) {
        if (attribute.name == name) return attribute;
    }
    ADD_FAILURE() << "no " << name;
    return {};
}

}  // namespace skybake::testing
