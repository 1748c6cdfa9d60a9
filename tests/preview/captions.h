// Shared by tests of all captions.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "bakers/plot/drawing.h"

namespace skybake::test {

// A caption is read by people: it begins as a sentence does, or with a name or a figure, and ends
// as one does.
inline void expect_sentences(const PreviewPicture& picture) {
    const std::string& caption = picture.caption;
    ASSERT_FALSE(caption.empty()) << picture.name;
    EXPECT_FALSE(std::islower(static_cast<unsigned char>(caption.front())))
        << picture.name << ": " << caption;
    EXPECT_EQ(caption.back(), '.') << picture.name << ": " << caption;
}

inline bool says(const PreviewPicture& picture, const std::string& words) {
    return picture.caption.find(words) != std::string::npos;
}

}  // namespace skybake::test
