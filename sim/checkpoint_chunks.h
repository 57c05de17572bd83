/*
 * How a checkpoint is made up: a signature, and chunks of 4 bytes name, 8 bytes size of the contents,
 * the contents, 4 bytes CRC-32 of all those. Numbers are little endian but for the blocks, which are
 * as the machine has them.
 *
 *     "HEAD"  4 bytes version, 4 bytes CHECKPOINT_ORDER as the machine has it, 8 bytes fingerprint of the meshes
 *     "KEYS"  the scene, a line PATH=VALUE for each key that a state depends on
 *     "RUN "  8 bytes first break and 8 bytes seconds (IEEE doubles), 8 bytes states shown
 *     "ROWS"  of the log
 *     "DATA"  4 bytes length of the block's name, the name, the block; one for each of sim_blocks(), in their order
 *     "END "  nothing
 */
#ifndef SIM_CHECKPOINT_CHUNKS_H
#define SIM_CHECKPOINT_CHUNKS_H

#include <stdint.h>

/* As in PNG, so that a transfer that changes line ends or drops the eighth bit is found out at once. */
extern const unsigned char checkpoint_signature[8];

enum {
    CHECKPOINT_NAME = 4,
    CHECKPOINT_CHUNK_HEAD = CHECKPOINT_NAME + 8,
    CHECKPOINT_CHUNK_TAIL = 4,
    CHECKPOINT_HEAD_SIZE = 16,
    CHECKPOINT_RUN_SIZE = 24,
};

#define CHECKPOINT_ORDER UINT32_C(0x01020304)

#endif
