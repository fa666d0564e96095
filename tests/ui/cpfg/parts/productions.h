/* Longer than the file that includes it, so that its places are none of that file. */
/* Longer than the file that includes it, so that its places are none of that file. */
A --> B C
	[ D
B --> S
