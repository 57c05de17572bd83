# every_call KIND[,lasting] COMMAND...: each of its calls fails once, see every_call.c; at most $MOST of them.
every_call()
{
    command_line="every_call $*"
    got=0
    "$EVERY_CALL" "$FAILING" "$MOST" "$@" || got=$?
    [ "$got" = 0 ] || exit "$got"
}

program() { command -v "$1" >/dev/null; }
