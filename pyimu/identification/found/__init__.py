"""What a result holds, as frozen data: its entries, what the page shows, what it was made with."""
