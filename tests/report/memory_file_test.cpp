#include "bakers/report/measurement.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace skybake {
namespace {

void write(const MemoryFile& file, const std::string& text) {
    std::ofstream stream(file.path(), std::ios::binary | std::ios::trunc);
    stream << text;
    EXPECT_TRUE(stream.good());
}

TEST(MemoryFile, HoldsWhatIsWrittenToItsPath) {
    const MemoryFile file;
    EXPECT_EQ(file.bytes(), 0u);
    write(file, "seven b");
    EXPECT_EQ(file.bytes(), 7u);
    std::string text;
    std::ifstream(file.path(), std::ios::binary) >> text;
    EXPECT_EQ(text, "seven");
    write(file, "b");
    EXPECT_EQ(file.bytes(), 1u);
}

TEST(MemoryFile, IsNoOtherMemoryFile) {
    const MemoryFile first;
    const MemoryFile second;
    write(first, "12345");
    EXPECT_EQ(first.bytes(), 5u);
    EXPECT_EQ(second.bytes(), 0u);
}

}  // namespace
}  // namespace skybake
