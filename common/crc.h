/* CRC-32 (ISO 3309, the one of PNG and zlib): finds any damage of up to 32 bits in a row. */
#ifndef COMMON_CRC_H
#define COMMON_CRC_H

#include <stddef.h>
#include <stdint.h>

/* The checksum of what came before (0: nothing) and these bytes. */
uint32_t crc32_bytes(uint32_t crc, const void *data, size_t size);

#endif
