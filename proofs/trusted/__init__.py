"""The trusted base: what a claim is, what terms there are, and the kernel that checks steps."""
