// The cases on a Cortex-M3 without an operating system: ARM's MPS2 board, application note 385, as qemu-system-arm has
// it (-M mps2-an385).
//
// There is no FPU: doubles are libgcc's soft-float, built on integers. The scenes are compiled in, the budget is fixed
// when the program is built, the log goes out by semihosting, and the picture that is sent leaves by
// the first serial port as a PPM, each line as it is finished. Nothing of newlib is used but memory moves and the
// square root. Before anything runs the stack is painted; at the end the deepest byte that was ever written is told.
#include <cstddef>
#include <cstdint>

#include "base/text.h"
#include "machines/cases.h"

extern "C" {
extern std::uint32_t data_load[], data_start[], data_end[], bss_start[], bss_end[], stack_low[], stack_high[];
void reset();
}

namespace {

alignas(8) __attribute__((section(".budget"))) unsigned char memory[machines::kBudgetBytes];

// ---- semihosting: a breakpoint with the operation in r0 asks the debugger, here QEMU

constexpr std::uint32_t kWriteText = 4, kExit = 0x20, kApplicationExit = 0x20026;

std::uint32_t ask(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

void print(const char* text) { ask(kWriteText, text); }

[[noreturn]] void leave(int status) {
  const std::uint32_t block[2] = {kApplicationExit, static_cast<std::uint32_t>(status)};
  for (;;) ask(kExit, block);
}

[[noreturn]] void fault() {
  print("fault: the processor stopped on an instruction or an address\n");
  leave(1);
}

// ---- the serial port: ARM's CMSDK UART

struct SerialPort {
  volatile std::uint32_t data, state, control, interrupts, divider;
};
SerialPort& port() { return *reinterpret_cast<SerialPort*>(0x40004000); }
constexpr std::uint32_t kSenderFull = 1, kSenderOn = 1;

void send(std::uint8_t byte) {
  while ((port().state & kSenderFull) != 0) {
  }
  port().data = byte;
}

/// Line after line of a PPM; the head goes out before the first.
bool send_line(void*, std::uint32_t y, std::span<const std::uint8_t> rgb) {
  if (y == 0) {
    char head[32];
    shodo::TextBuilder text(head, sizeof head);
    text.add("P6\n").add(rgb.size() / 3).add(" ").add(machines::kSentHeight).add("\n255\n");
    for (const char c : text.text()) send(static_cast<std::uint8_t>(c));
  }
  for (const std::uint8_t byte : rgb) send(byte);
  return true;
}

// ---- the stack

constexpr std::uint32_t kPaint = 0x5a5a5a5a;

/// All that is free below this function's frame.
__attribute__((noinline)) void paint_stack() {
  const std::uint32_t* top;
  asm volatile("mov %0, sp" : "=r"(top));
  for (volatile std::uint32_t* word = stack_low; word < top; ++word) *word = kPaint;
}

std::size_t stack_used() {
  const std::uint32_t* word = stack_low;
  while (word < stack_high && *word == kPaint) ++word;
  return static_cast<std::size_t>(stack_high - word) * sizeof(std::uint32_t);
}

int run() {
  port().divider = 16;
  port().control = kSenderOn;
  paint_stack();
  const int status = machines::run_cases({memory, print, {send_line, nullptr}, false}, "");
  char line[64];
  shodo::TextBuilder(line, sizeof line).add("stack ").add(stack_used()).add("\n");
  print(line);
  return status;
}

}  // namespace

/// Where the processor starts: the stack pointer and what it does on reset and on each of its own exceptions.
__attribute__((section(".vectors"), used)) void* const kVectors[16] = {
    stack_high,
    reinterpret_cast<void*>(reset), reinterpret_cast<void*>(fault), reinterpret_cast<void*>(fault),
    reinterpret_cast<void*>(fault), reinterpret_cast<void*>(fault), reinterpret_cast<void*>(fault),
};

void reset() {
  const std::uint32_t* from = data_load;
  for (std::uint32_t* to = data_start; to < data_end; ++to) *to = *from++;
  for (std::uint32_t* to = bss_start; to < bss_end; ++to) *to = 0;
  leave(run());
}
