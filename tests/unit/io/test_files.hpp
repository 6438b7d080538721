// For tests of common/io: what files hold, and the shape every error must have. Nothing is read from the
// source tree, so each test shows all of its input.
#pragma once

#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gll::test {

inline std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
}

// work() must throw std::runtime_error whose message is one line, begins with the path and holds all of
// `parts`.
template <typename Work>
void expectError(const std::filesystem::path& path, std::initializer_list<std::string_view> parts,
                 const Work& work) {
    try {
        work();
        ADD_FAILURE() << path << ": no error";
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with(path.string() + ":")) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        for (const std::string_view part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is missing in: " << message;
    }
}

} // namespace gll::test
