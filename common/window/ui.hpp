// Dear ImGui in the window: fonts, scale and style, and the few widgets that all panels share. Lengths are in
// ems, the height of a line of text, so that one number serves every display.
#pragma once

#include <string>
#include <string_view>

struct GLFWwindow;
struct ImFont;

namespace gll {

class WindowContext;

class Ui {
  public:
    // Made after the window's own callbacks are set, which Dear ImGui then passes events on to.
    explicit Ui(const WindowContext& window);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    // Around everything that is drawn in a frame. Where the display's scale or the wished size of text have
    // changed, begin() makes the fonts anew. wish: 0.5 to 3, 1 is as the display wants it.
    void begin(float wish);
    // Draws over the framebuffer 0, which must be bound.
    void end();

    // The wish alone, for layouts before the first frame.
    void setWish(float wish);

    // Pixels: what layouts divide the window by.
    float emPx() const { return em_px_; }

    // Whether the mouse or keyboard is busy in what is drawn here, so that they mean nothing to the scene.
    bool hasMouse() const;
    bool hasKeyboard() const;
    bool isTyping() const; // into a field

    // The mouse cursor is somebody else's to set.
    void keepCursor(bool is_kept);

    // Closes the list of choices that is open, and ends moving about by keyboard. False where none is.
    bool closePopup();
    bool leavePanel();

    static bool isPopupOpen();
    // The fonts of what is drawn next, until popFont().
    static void pushBold();
    static void pushMono();
    static void popFont();

  private:
    void makeFonts(float em_px, float pixels_per_unit);

    const WindowContext& window_;
    float em_px_ = 0;
    float pixels_per_unit_ = 0;
};

// A place and size in the window's pixels as ImGui's next window, which cannot be moved.
struct Rectangle;
void nextWindowAt(const Rectangle& rectangle, float pixels_per_unit);

// Of the widget before it, where the mouse has rested on that, greyed ones too: beside the window it is in
// where there is room, else below or above it; wrapped, and never beyond the display.
void tooltip(std::string_view text);

// As ImGui's, but Esc closes it.
bool beginCombo(const char* label, const char* chosen);

void wrappedText(std::string_view text);

// At the bottom of a place, over all else, moving nothing. Colours as ImGui's popups.
void messageOver(const Rectangle& place, float pixels_per_unit, const std::string& text);

} // namespace gll
