// Finding the places for faults: a scanner for GLSL's tokens, and one rule for each kind of fault.
#include "frame_check/mutants.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

namespace gll::frame_check {
namespace {

struct Token {
    enum class Kind { name, number, sign };
    Kind kind = Kind::sign;
    std::size_t at = 0; // bytes from the beginning of the file
    std::string text = {};
};

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Without comments and preprocessor lines.
std::vector<Token> tokensOf(const std::string& text) {
    static const std::array<std::string_view, 14> pairs = {
        "+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "&&", "||", "<<", ">>", "++", "--"};
    std::vector<Token> tokens;
    bool line_is_empty = true;
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = std::string_view(text).substr(i);
        const auto c = static_cast<unsigned char>(text[i]);
        if (rest.starts_with("//") || (c == '#' && line_is_empty)) {
            i = std::min(text.find('\n', i), text.size());
        } else if (rest.starts_with("/*")) {
            i = std::min(text.find("*/", i), text.size() - 2) + 2;
        } else if (std::isspace(c) != 0) {
            line_is_empty = line_is_empty || c == '\n';
            ++i;
        } else {
            Token token{.at = i};
            const bool is_number =
                std::isdigit(c) != 0 || (c == '.' && rest.size() > 1 && std::isdigit(rest[1]) != 0);
            std::size_t length = 1;
            if (is_number) {
                token.kind = Token::Kind::number;
                while (length < rest.size() &&
                       (isWordCharacter(rest[length]) || rest[length] == '.' ||
                        ((rest[length] == '-' || rest[length] == '+') && rest[length - 1] == 'e')))
                    ++length;
            } else if (isWordCharacter(text[i])) {
                token.kind = Token::Kind::name;
                while (length < rest.size() && isWordCharacter(rest[length]))
                    ++length;
            } else if (std::find(pairs.begin(), pairs.end(), rest.substr(0, 2)) != pairs.end()) {
                length = 2;
            }
            token.text = rest.substr(0, length);
            tokens.push_back(token);
            line_is_empty = false;
            i += length;
        }
    }
    return tokens;
}

const std::map<std::string, std::string> other_arithmetic = {
    {"+", "-"}, {"-", "+"}, {"*", "/"}, {"/", "*"}, {"+=", "-="}, {"-=", "+="}, {"*=", "/="}};
const std::map<std::string, std::string> other_comparison = {{"<", ">="}, {"<=", ">"},  {">", "<="},
                                                             {">=", "<"}, {"==", "!="}, {"!=", "=="}};
const std::map<std::string, std::string> other_logic = {{"&&", "||"}, {"||", "&&"}};
const std::map<std::string, std::string> functions = {
    {"min", "max"}, {"max", "min"}, {"sin", "cos"}, {"cos", "sin"}, {"floor", "ceil"}};
const std::set<std::string> keywords = {"if",   "for", "while", "return", "layout",
                                        "else", "in",  "out",   "const"};

class Finder {
  public:
    Finder(const std::string& file, const std::string& text)
        : file_(file), text_(text), tokens_(tokensOf(text)), partner_(tokens_.size(), tokens_.size()) {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const std::string& sign = tokens_[i].text;
            if (sign == "(" || sign == "[" || sign == "{") open.push_back(i);
            if ((sign == ")" || sign == "]" || sign == "}") && !open.empty()) {
                partner_[i] = open.back();
                partner_[open.back()] = i;
                open.pop_back();
            }
        }
    }

    std::vector<Mutant> run() {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (isInterface(i)) {
                while (i < tokens_.size() && tokens_[i].text != ";")
                    ++i;
                continue;
            }
            const Token& token = tokens_[i];
            if (token.kind == Token::Kind::number) constant(i);
            if (token.kind == Token::Kind::sign) sign(i);
            if (token.kind == Token::Kind::name) name(i);
        }
        return std::move(mutants_);
    }

  private:
    const std::string& is(std::size_t i) const {
        static const std::string none;
        return i < tokens_.size() ? tokens_[i].text : none;
    }
    std::size_t endOf(std::size_t i) const { return tokens_[i].at + tokens_[i].text.size(); }
    std::string between(std::size_t first, std::size_t last) const { // both tokens included
        return text_.substr(tokens_[first].at, endOf(last) - tokens_[first].at);
    }

    // A declaration of uniforms, inputs or outputs. Blocks and function bodies begin otherwise.
    bool isInterface(std::size_t i) const {
        const std::string& before = i > 0 ? is(i - 1) : ";";
        if (before != ";" && before != "}") return false;
        return is(i) == "uniform" || is(i) == "layout" || is(i) == "in" || is(i) == "out" || is(i) == "flat";
    }

    // Tokens first to last, both included, become `with`.
    void add(const std::string& operation, std::size_t first, std::size_t last, const std::string& with) {
        if (last >= tokens_.size()) return; // an operator or a bracket without what belongs to it
        const std::size_t begin = tokens_[first].at;
        const std::size_t end = endOf(last);
        Mutant mutant{.file = file_, .operation = operation};
        mutant.line = static_cast<int>(
            std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n') + 1);
        mutant.text = text_.substr(0, begin) + with + text_.substr(end);
        const std::size_t line_begin = text_.rfind('\n', begin) + 1;
        const std::size_t line_end = std::min(text_.find('\n', end), text_.size());
        mutant.before = oneSpaced(text_.substr(line_begin, line_end - line_begin));
        mutant.after = oneSpaced(text_.substr(line_begin, begin - line_begin) + with +
                                 text_.substr(end, line_end - end));
        if (mutant.before != mutant.after) mutants_.push_back(std::move(mutant));
    }

    static std::string oneSpaced(const std::string& text) {
        std::string result;
        for (const char c : text)
            if (std::isspace(static_cast<unsigned char>(c)) == 0)
                result += c;
            else if (!result.empty() && result.back() != ' ')
                result += ' ';
        while (result.ends_with(' '))
            result.pop_back();
        return result;
    }

    void constant(std::size_t i) {
        const std::string& text = tokens_[i].text;
        if (text.find_first_of("xuXU") != std::string::npos || is(i - 1) == "[") return;
        const double value = std::strtod(text.c_str(), nullptr);
        if (text.find_first_of(".e") == std::string::npos)
            add("constant", i, i, std::to_string(static_cast<std::int64_t>(std::min(value, 1e15)) + 1));
        else if (value == 0)
            add("constant", i, i, "0.1");
        else if (value >= 1e-3 && value <= 1e4)
            add("constant", i, i, "(1.1 * " + text + ")");
    }

    bool isBinary(std::size_t i) const {
        if (i == 0) return false;
        const Token& before = tokens_[i - 1];
        return before.text == ")" || before.text == "]" ||
               (before.kind != Token::Kind::sign && !keywords.contains(before.text));
    }

    void sign(std::size_t i) {
        const std::string& text = tokens_[i].text;
        const bool is_binary = isBinary(i);
        for (const auto& [operation, swapped] :
             {std::pair("arithmetic", &other_arithmetic), std::pair("comparison", &other_comparison),
              std::pair("logic", &other_logic)})
            if (const auto found = swapped->find(text); found != swapped->end() && is_binary)
                add(operation, i, i, found->second);
        if (text == "-" && !is_binary) add("sign", i, i, "");
        if (text == "!") add("sign", i, i, "");
        if ((text == "+" || text == "-") && is_binary) add("term", i, endOfOperand(i, "+-"), "");
        if ((text == "*" || text == "/") && is_binary) add("factor", i, endOfOperand(i, "+-*/"), "");
        if (text == "?") ternary(i);
        if (text == "=" || text == "+=" || text == "-=" || text == "*=" || text == "/=") assignment(i);
    }

    // The last token of what stands right of the operator at i, where one of `operators` ends it, as what
    // binds less does.
    std::size_t endOfOperand(std::size_t i, std::string_view operators) const {
        std::size_t last = i + 1;
        for (std::size_t j = i + 1; j < tokens_.size(); ++j) {
            const std::string& text = tokens_[j].text;
            if (partner_[j] < j || text == "," || text == ";" || text == "?" || text == ":") break;
            if (other_comparison.contains(text) || other_logic.contains(text)) break;
            if (text.size() == 1 && operators.find(text) != std::string_view::npos && isBinary(j)) break;
            if (partner_[j] < tokens_.size()) j = partner_[j];
            last = j;
        }
        return last;
    }

    // condition ? one : other becomes one, or other.
    void ternary(std::size_t i) {
        std::size_t first = i;
        while (first > 0) {
            const std::string& text = tokens_[first - 1].text;
            if (text == "(" || text == "," || text == "=" || text == "return" || text == ":" || text == "?" ||
                text == ";" || text == "{" || text == "[" ||
                (text.size() == 2 && text[1] == '=' && other_arithmetic.contains(text)))
                break;
            --first;
            if (partner_[first] < first) first = partner_[first];
        }
        std::size_t colon = i + 1;
        for (int open = 0; colon < tokens_.size(); ++colon) {
            if (tokens_[colon].text == "?") ++open;
            if (tokens_[colon].text == ":" && open-- == 0) break;
            if (partner_[colon] < tokens_.size() && partner_[colon] > colon) colon = partner_[colon];
        }
        std::size_t last = colon;
        for (std::size_t j = colon + 1; j < tokens_.size(); ++j) {
            if (partner_[j] < j || tokens_[j].text == "," || tokens_[j].text == ";") break;
            if (partner_[j] < tokens_.size()) j = partner_[j];
            last = j;
        }
        if (colon + 1 >= tokens_.size() || last == colon) return;
        add("branch", first, last, "(" + between(i + 1, colon - 1) + ")");
        add("branch", first, last, "(" + between(colon + 1, last) + ")");
    }

    // Leaves out a statement that changes a variable.
    void assignment(std::size_t i) {
        std::size_t first = i;
        while (first > 0 && tokens_[first - 1].text != ";" && tokens_[first - 1].text != "{" &&
               tokens_[first - 1].text != "}" && tokens_[first - 1].text != ")" &&
               tokens_[first - 1].text != "else")
            --first;
        if (first + 1 < i && tokens_[first + 1].kind == Token::Kind::name) return; // declares it: "float x ="
        std::size_t last = i;
        while (last < tokens_.size() && tokens_[last].text != ";")
            last = partner_[last] < tokens_.size() && partner_[last] > last ? partner_[last] + 1 : last + 1;
        if (last < tokens_.size()) add("statement", first, last, ";");
    }

    void name(std::size_t i) {
        const std::string& text = tokens_[i].text;
        if (i > 0 && is(i - 1) == ".") return channels(i);
        if (is(i + 1) != "(") return;
        if (text == "if" && partner_[i + 1] < tokens_.size()) {
            const std::string condition = between(i + 1, partner_[i + 1]);
            add("never", i + 1, partner_[i + 1], "(false)");
            add("negated", i + 1, partner_[i + 1], "(!" + condition + ")");
            return;
        }
        const bool is_declared =
            i > 0 && tokens_[i - 1].kind == Token::Kind::name && !keywords.contains(is(i - 1));
        if (keywords.contains(text) || is_declared) return;
        if (const auto found = functions.find(text); found != functions.end())
            add("function", i, i, found->second);
        call(i);
    }

    void channels(std::size_t i) {
        const std::string& text = tokens_[i].text;
        if (text.size() > 4 || (text.find_first_not_of("xyzw") != std::string::npos &&
                                text.find_first_not_of("rgba") != std::string::npos))
            return;
        static const std::map<std::string, std::string> single = {
            {"x", "y"}, {"y", "x"}, {"z", "x"}, {"w", "x"}, {"r", "g"}, {"g", "r"}, {"b", "r"}, {"a", "r"}};
        if (text.size() == 1)
            add("channel", i, i, single.at(text));
        else
            add("channel", i, i, std::string(text.rbegin(), text.rend()));
    }

    // A call becomes one of its arguments; a texture is read beside the place.
    void call(std::size_t i) {
        const std::string& text = tokens_[i].text;
        const std::size_t close = partner_[i + 1];
        std::vector<std::pair<std::size_t, std::size_t>> arguments; // first and last token
        for (std::size_t j = i + 2, first = j; j <= close && close < tokens_.size(); ++j) {
            if (j == close || tokens_[j].text == ",") {
                if (j > first) arguments.emplace_back(first, j - 1);
                first = j + 1;
            } else if (partner_[j] < tokens_.size() && partner_[j] > j) {
                j = partner_[j];
            }
        }
        if (arguments.empty()) return;
        if (text.starts_with("texture") || text == "texelFetch") {
            if (arguments.size() < 2 || text == "textureSize") return;
            const auto [first, last] = arguments[1];
            add("sample", first, last, between(first, last) + (text == "texelFetch" ? " + 1" : " + 0.02"));
            return;
        }
        static const std::set<std::string> constructors = {"float", "int",  "uint",  "bool",  "vec2",
                                                           "vec3",  "vec4", "ivec2", "ivec3", "uvec2",
                                                           "uvec3", "mat2", "mat3",  "mat4"};
        if (constructors.contains(text)) return;
        const bool by_last = text == "smoothstep" || text == "step";
        const auto [first, last] = by_last ? arguments.back() : arguments.front();
        add("bypass", i, close, "(" + between(first, last) + ")");
        if (text == "mix" && arguments.size() == 3)
            add("bypass", i, close, "(" + between(arguments[1].first, arguments[1].second) + ")");
    }

    const std::string& file_;
    const std::string& text_;
    std::vector<Token> tokens_;
    std::vector<std::size_t> partner_; // of a bracket, the other one; else beyond the end
    std::vector<Mutant> mutants_;
};

} // namespace

std::vector<Mutant> mutantsOf(const std::string& file, const std::string& text) {
    return Finder(file, text).run();
}

} // namespace gll::frame_check
