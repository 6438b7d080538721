// Shader stages from files: definitions, what they include, and errors that name the file and line.
#pragma once

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace gll {

// One "#define name value" put after the #version line of every stage.
struct Define {
    std::string name;
    std::string value;
};
using Defines = std::vector<Define>;

inline Defines operator+(Defines left, const Defines& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

// What is wrong with a shader, and where. what() is "file:line: complaint", as far as these are known.
struct ShaderError : std::runtime_error {
    ShaderError(std::string in_file, int at_line, std::string says, std::string line_text = {});

    std::string file; // relative to the shader root, or a program's name
    int line;         // from 1; 0: not known
    std::string complaint;
    std::string source_line;                  // as it stands in the file; empty: not known
    std::vector<std::filesystem::path> tried; // where a file was sought that is not there; else empty
};

struct ShaderFile {
    std::string name;                // relative to the shader root
    std::filesystem::path path = {}; // canonical
    std::string text = {};
};

// A shader stage after its includes were put in. Line markers count files by their place in this list, and
// lines from 100,000 times that.
struct ShaderSource {
    std::string text;
    std::vector<ShaderFile> files;

    // The first complaint of a compiler's log on this text, with the file and line it is of.
    ShaderError firstComplaint(const std::string& log) const;
};

// Reads a stage and puts in what it includes: #include "lib/x.glsl" is looked up under the same roots, a file
// is put in once, at most 16 deep, and never from outside its root. Throws ShaderError, for a file that is
// not there with every path tried. looked_for, unless null, is given the canonical path of every file read or
// tried, also where this throws.
ShaderSource readShader(const std::vector<std::filesystem::path>& roots, const std::string& file,
                        const Defines& defines = {}, std::set<std::filesystem::path>* looked_for = nullptr);

} // namespace gll
