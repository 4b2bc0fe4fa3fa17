"""What benchmarks of many cases share: they run in parallel, resume, and state intervals."""
