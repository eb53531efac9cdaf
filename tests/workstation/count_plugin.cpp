// Counts what a big-endian MIPS program executes under qemu-mips: the ruler for workstation seconds (design 8).
//
// Every instruction is counted, and besides: floating-point operations (add, subtract, multiply, divide, square root,
// convert, compare; moves, loads and stores are none), integer multiplications and integer divisions. A translation
// block is counted when it is entered, so the figures depend on the program and its input alone and repeat to the last
// digit. The program marks a stage by close(-1000 - stage), which fails and does nothing else; what follows is counted
// for that stage. At exit one line a stage: stage, instructions, floating-point operations, multiplications, divisions.
//
// The declarations below are those of QEMU's plugin interface, version 1, which has no header in Debian 12.
#include <cstddef>
#include <cstdint>
#include <cstdio>

extern "C" {
struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info_t;
using qemu_plugin_id_t = std::uint64_t;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_inline(qemu_plugin_tb*, qemu_plugin_op, void*, std::uint64_t);
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb*);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb*, std::size_t);
const void* qemu_plugin_insn_data(const qemu_plugin_insn*);
using SyscallCallback = void (*)(qemu_plugin_id_t, unsigned, std::int64_t, std::uint64_t, std::uint64_t, std::uint64_t,
                                 std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t);
void qemu_plugin_register_vcpu_syscall_cb(qemu_plugin_id_t, SyscallCallback);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void*), void*);
void qemu_plugin_outs(const char*);

extern int qemu_plugin_version;
int qemu_plugin_install(qemu_plugin_id_t, const qemu_info_t*, int, char**);
}

namespace {

constexpr int kStages = 16;
constexpr std::int64_t kCloseOfMips = 4006;  // o32
constexpr std::int32_t kFirstMark = -1000;

struct Counts {
  std::uint64_t instructions = 0, floating = 0, multiplications = 0, divisions = 0;
};

// QEMU adds to these in the translated code; the plugin interface has no other place to keep them.
Counts running;
Counts at_last_mark;
Counts of_stage[kStages];
int stage = 0;

void close_stage() {
  Counts& s = of_stage[stage];
  s.instructions += running.instructions - at_last_mark.instructions;
  s.floating += running.floating - at_last_mark.floating;
  s.multiplications += running.multiplications - at_last_mark.multiplications;
  s.divisions += running.divisions - at_last_mark.divisions;
  at_last_mark = running;
}

/// Arithmetic of coprocessor 1 in format S, D, W or L: ADD SUB MUL DIV SQRT (0-4), ROUND TRUNC CEIL FLOOR (8-15),
/// CVT (32-37) and C.cond (48-63); ABS, MOV and NEG (5-7) aren't operations in this count.
bool is_floating(std::uint32_t word) {
  if (word >> 26 != 0x11) return false;
  const std::uint32_t format = word >> 21 & 31, function = word & 63;
  if (format != 16 && format != 17 && format != 20 && format != 21) return false;
  return function <= 4 || (function >= 8 && function <= 15) || (function >= 32 && function <= 37) || function >= 48;
}

void count_block(qemu_plugin_id_t, qemu_plugin_tb* block) {
  Counts here;
  here.instructions = qemu_plugin_tb_n_insns(block);
  for (std::size_t k = 0; k < here.instructions; ++k) {
    const auto* byte = static_cast<const unsigned char*>(qemu_plugin_insn_data(qemu_plugin_tb_get_insn(block, k)));
    const std::uint32_t word = std::uint32_t{byte[0]} << 24 | std::uint32_t{byte[1]} << 16 |
                               std::uint32_t{byte[2]} << 8 | std::uint32_t{byte[3]};
    if (is_floating(word)) ++here.floating;
    const bool special = word >> 26 == 0;
    if (special && ((word & 63) == 0x18 || (word & 63) == 0x19)) ++here.multiplications;
    if (special && ((word & 63) == 0x1a || (word & 63) == 0x1b)) ++here.divisions;
  }
  const auto add = [&](std::uint64_t& counter, std::uint64_t amount) {
    if (amount > 0) qemu_plugin_register_vcpu_tb_exec_inline(block, QEMU_PLUGIN_INLINE_ADD_U64, &counter, amount);
  };
  add(running.instructions, here.instructions);
  add(running.floating, here.floating);
  add(running.multiplications, here.multiplications);
  add(running.divisions, here.divisions);
}

void watch_marks(qemu_plugin_id_t, unsigned, std::int64_t number, std::uint64_t first, std::uint64_t, std::uint64_t,
                 std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t) {
  const auto descriptor = static_cast<std::int32_t>(first);
  if (number != kCloseOfMips || descriptor > kFirstMark || descriptor <= kFirstMark - kStages) return;
  close_stage();
  stage = kFirstMark - descriptor;
}

void print_counts(qemu_plugin_id_t, void*) {
  close_stage();
  for (int k = 0; k < kStages; ++k) {
    const Counts& s = of_stage[k];
    if (s.instructions == 0) continue;
    char line[160];
    std::snprintf(line, sizeof line, "count %d %llu %llu %llu %llu\n", k,
                  static_cast<unsigned long long>(s.instructions), static_cast<unsigned long long>(s.floating),
                  static_cast<unsigned long long>(s.multiplications),
                  static_cast<unsigned long long>(s.divisions));
    qemu_plugin_outs(line);
  }
}

}  // namespace

int qemu_plugin_version = 1;

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t*, int, char**) {
  qemu_plugin_register_vcpu_tb_trans_cb(id, count_block);
  qemu_plugin_register_vcpu_syscall_cb(id, watch_marks);
  qemu_plugin_register_atexit_cb(id, print_counts, nullptr);
  return 0;
}
