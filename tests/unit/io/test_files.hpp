// Files for tests of common/io: a folder that vanishes, files written into it, and the shape every error must
// have. Nothing is read from the source tree, so each test shows all of its input.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include <unistd.h>

namespace gll::test {

// A fresh folder, removed with all it holds at the end of the test.
class TestFolder {
  public:
    TestFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "gll_io_XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
        path = name;
    }
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    // Writes a file, with the folders on its way, and returns its path.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        const std::filesystem::path file = path / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return file;
    }

    std::filesystem::path path;
};

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
